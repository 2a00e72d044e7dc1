// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/Landing.h"

#include "Base/SmoothStep.h"
#include "Rotation/RigidBody.h"
#include "Rotation/Rolling.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{
constexpr double NearTime = 2.0;     // s before the centre is at rest
constexpr double RockingTime = 1.2;  // s after it, at most
constexpr double LongestGive = 0.35; // of the bounding radius, that the ground lifts a centre
constexpr double EnoughUp = 0.6;     // cosine, from which the ground does the rest of a turn
constexpr double LeastSlope = 0.1;   // z of the steepest normal, as of RestingPosition
constexpr double SameSurface = 0.9;  // cosine between the normals
constexpr double FarAway = 1e300;    // m
constexpr double StillAngle = 0.12;  // rad, off the pose at rest
constexpr double StillRate = 0.3;    // rad/s
constexpr double StillTime = 0.25;   // s, in which the last of it goes
constexpr double LeastTime = 0.1;    // s
constexpr double FarFromRest = 0.35; // rad

/// Turns the poses before a frame to the lying one, more and more.
void BlendTo(const Quat& lying, int frame, int first, FrameMarks& marks, std::vector<Quat>& poses)
{
  Quat after = Quat::Identity();
  for (int i = frame - 1; i > first; --i)
  {
    // The same way round as a frame later: the turn left to do never jumps.
    Quat left = lying * poses[i].conjugate();
    if (left.dot(after) < 0.0)
    {
      left.coeffs() = -left.coeffs();
    }
    after = left;
    const double fraction = SmoothStep(static_cast<double>(i - first) / (frame - first));
    poses[i] = (ExpMap(fraction * SignedLogMap(left)) * poses[i]).normalized();
    marks.Changed[i] = 1;
  }
}
} // namespace

Landing::Landing(const AttitudePlan& plan, const PlannedRest& rest, const Constraint* key,
                 bool held) :
  Plan(&plan),
  Rest(&rest), Key(key), Held(held)
{
  const double fps = plan.Time.FramesPerSecond;
  const int last = static_cast<int>(plan.Path->Positions.size()) - 1;
  this->First = rest.Frame - static_cast<int>(std::lround(NearTime * fps));
  this->End = rest.Frame;
  if (rest.ObstacleId < 0 || held)
  {
    return;
  }
  this->End = std::min({ rest.Deadline, rest.Until, last,
                         rest.Frame + static_cast<int>(std::lround(RockingTime * fps)) });
  this->End = std::max(this->End, std::min(rest.Frame, last));
  const std::vector<Vec3>& points = plan.Body->Mesh.Points;
  const Vec3& centre =
    plan.Path->Positions[static_cast<std::size_t>(std::clamp(rest.Frame, 0, last))];
  const double height = (centre - rest.Point.At(rest.Frame)).dot(rest.Normal);
  const auto rise = [&](double side)
  {
    const Quat level = this->Level(Quat::Identity(), side);
    const Quat lying = key == nullptr ? RollDown(points, level, rest.Normal) : level;
    return StandingHeight(points, lying, rest.Normal) - height;
  };
  this->RiseUp = rise(1.0);
  this->RiseDown = rise(-1.0);
}

bool Landing::IsUp(const Quat& orientation) const
{
  return (orientation * Vec3::UnitZ()).dot(this->Rest->Normal) >= 0.0;
}

Quat Landing::Level(const Quat& orientation, double side) const
{
  const Mat3 axes = orientation.toRotationMatrix();
  return (LeastTurn(axes.col(2), side * this->Rest->Normal, axes.col(0)) * orientation)
    .normalized();
}

/// The pose in which it stands, put down like that. Where that is on an edge or on its end, as a
/// bent sheet does on a bent edge, it falls over: the path leads to where it lies.
Quat Landing::Roll(const Quat& orientation) const
{
  const std::vector<Vec3>& points = this->Plan->Body->Mesh.Points;
  const auto height = [&](const Quat& q) { return StandingHeight(points, q, this->Rest->Normal); };
  const Quat standing = RollDown(points, orientation, this->Rest->Normal);
  const double lying =
    std::max(height(this->Level(orientation, 1.0)), height(this->Level(orientation, -1.0)));
  return height(standing) <= lying + this->Plan->Tolerance
           ? standing
           : RollDown(points, this->Level(orientation, this->IsUp(orientation) ? 1.0 : -1.0),
                      this->Rest->Normal);
}

Settling Landing::Draw(int frame, const Quat& orientation) const
{
  Settling settling;
  settling.Normal = this->Rest->Normal;
  // A little earlier than the blend to the lying pose, so that little is left for it to do.
  const double time = std::max(this->Plan->LandingTime, 1e-9);
  const double left = (this->Rest->Frame - frame) / this->Plan->Time.FramesPerSecond;
  settling.Weight = SmoothStep((1.4 * time - left) / (0.6 * time));
  if (this->Rest->ObstacleId < 0 || this->Key != nullptr)
  {
    settling.Normal *= this->Key == nullptr || this->IsUp(this->Key->Orientation) ? 1.0 : -1.0;
    return settling;
  }
  if (this->Rest->Side == FaceUp::Any)
  {
    return Settling();
  }
  settling.Normal *= this->Rest->Side == FaceUp::Up ? 1.0 : -1.0;
  const double up = (orientation * Vec3::UnitZ()).dot(settling.Normal);
  settling.Weight *= SmoothStep((EnoughUp - up) / EnoughUp);
  return settling;
}

double Landing::Rise(int frame, const Quat& orientation) const
{
  const double span = 0.5 * this->Plan->LandingTime * this->Plan->Time.FramesPerSecond;
  const double part = SmoothStep(1.0 - (this->Rest->Frame - frame) / std::max(span, 1.0));
  return part * (this->IsUp(orientation) ? this->RiseUp : this->RiseDown);
}

double Landing::Give(int frame) const
{
  if (this->Rest->ObstacleId < 0 || this->Held)
  {
    return 0.0;
  }
  const double span =
    std::max(0.5 * this->Plan->LandingTime * this->Plan->Time.FramesPerSecond, 1.0);
  return LongestGive * this->Plan->BoundingRadius *
         std::min(SmoothStep((frame - this->First) / span), SmoothStep((this->End - frame) / span));
}

void Landing::Support(int frame, const Quat& orientation, double step, Floor& floor) const
{
  const double rise = this->Rise(frame, orientation);
  floor.Height += rise;
  floor.Rate += (this->Rise(frame + 1, orientation) - rise) / step;
  floor.Give = this->Give(frame);
  floor.GiveRate = (this->Give(frame + 1) - floor.Give) / step;
  floor.Lifts = this->Rest->ObstacleId >= 0 && !this->Held &&
                floor.Normal.dot(this->Rest->Normal) > SameSurface;
  floor.Weight = this->Held ? 0.0 : this->Plan->Object->Mass * StandardGravity;
}

double Landing::HeightOfPath(int frame) const
{
  const ObstacleSet* obstacles = this->Plan->Obstacles;
  return obstacles == nullptr ? FarAway
                              : obstacles->SignedDistance(this->Plan->Path->Positions[frame], frame,
                                                          2.0 * this->Plan->BoundingRadius);
}

bool Landing::Touches(int frame, const Quat& orientation) const
{
  return StandingHeight(this->Plan->Body->Mesh.Points, orientation, this->Rest->Normal) >=
         this->HeightOfPath(frame) + this->Rise(frame, orientation);
}

double Landing::Lift(int frame, const Quat& orientation) const
{
  if (this->Held || this->Rest->ObstacleId < 0)
  {
    return 0.0;
  }
  const double standing =
    StandingHeight(this->Plan->Body->Mesh.Points, orientation, this->Rest->Normal) -
    this->HeightOfPath(frame);
  const double lift =
    frame >= this->Rest->Frame ? standing : std::max(standing, this->Rise(frame, orientation));
  return lift / std::max(this->Rest->Normal.z(), LeastSlope);
}

RestingPose Landing::Lay(const Quat& arriving) const
{
  const Quat heading = this->Key != nullptr ? this->Key->Orientation.normalized() : arriving;
  RestingPose level;
  level.Orientation =
    this->Level(heading, this->Key == nullptr || this->IsUp(heading) ? 1.0 : -1.0);
  if (this->Rest->ObstacleId < 0)
  {
    return level;
  }
  if (this->Key == nullptr)
  {
    level.Orientation = this->Roll(arriving);
    const bool isUp = this->IsUp(level.Orientation);
    if (this->Rest->Side != FaceUp::Any && isUp != (this->Rest->Side == FaceUp::Up))
    {
      level.Orientation = this->Roll(this->Level(arriving, isUp ? -1.0 : 1.0));
    }
  }
  const double most =
    this->Plan->Tolerance + std::max(std::abs(this->RiseUp), std::abs(this->RiseDown));
  const auto first = static_cast<std::size_t>(std::max(this->Rest->Frame, 0));
  return LayDown(this->Plan->Body->Mesh, *this->Plan->Obstacles, static_cast<double>(first),
                 this->Plan->Path->Positions[first], this->Rest->Normal, level.Orientation,
                 this->Held ? 0.0 : most, this->Key == nullptr);
}

int Landing::StillFrom(const PoseTrack& poses, const Quat& lying) const
{
  int still = this->End;
  while (still > this->Rest->Frame &&
         LogMap(lying * poses.Orientations[still - 1].conjugate()).norm() < StillAngle &&
         poses.AngularVelocities[still - 1].norm() < StillRate)
  {
    --still;
  }
  const double fps = this->Plan->Time.FramesPerSecond;
  return std::min(this->End, still + static_cast<int>(std::lround(StillTime * fps)));
}

RestingPose Landing::Settle(int from, int first, FrameMarks& marks, AttitudeOutcome& out,
                            RestTimes& times) const
{
  std::vector<Quat>& poses = out.Poses.Orientations;
  const RestingPose laid = this->Lay(poses[this->End]);
  const int still = this->StillFrom(out.Poses, laid.Orientation);
  times = { this->Rest->Row, this->Rest->Target, this->Rest->Frame, still };
  for (int k = first; k < still; ++k)
  {
    if (k < times.TouchDown && this->Touches(k, poses[k]))
    {
      times.TouchDown = k;
    }
    if (marks.Frames[k].Freedom != PoseFreedom::Fixed)
    {
      marks.Frames[k] = { PoseFreedom::Landing, laid.Orientation };
    }
  }
  // What is left to turn is little, but where the body could not fall by itself, and is not turned
  // before it touches, but where it touches too late.
  const double fps = this->Plan->Time.FramesPerSecond;
  const double left = LogMap(laid.Orientation * poses[still].conjugate()).norm();
  const double time = left > FarFromRest
                        ? this->Plan->LandingTime
                        : std::clamp((still - times.TouchDown) / fps, LeastTime, StillTime);
  const int span = std::max(static_cast<int>(std::lround(time * fps)), 1);
  BlendTo(laid.Orientation, still, std::max(from, still - span), marks, poses);
  // On rough ground it lies otherwise than on the plane.
  const double missing = laid.Shift - this->Lift(still, laid.Orientation);
  marks.Moved = std::max(marks.Moved, std::abs(missing));
  for (int k = first; k < still; ++k)
  {
    const double part = SmoothStep(1.0 - static_cast<double>(still - k) / span);
    marks.Shifts[k] = (this->Lift(k, poses[k]) + part * missing) * Vec3::UnitZ();
    marks.Landing[k] = 1;
  }
  return laid;
}

} // namespace waft
