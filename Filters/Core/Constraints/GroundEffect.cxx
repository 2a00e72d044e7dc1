// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/GroundEffect.h"

#include "Base/BodyLaw.h"
#include "Base/SmoothStep.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

constexpr double LandingCushionTime = 0.15; // s
// s before a touch-down: what is low before the first hovers by itself, and from the second on the
// cushion bears it whole.
constexpr double CushionBegins = 0.3;
constexpr double CushionIsWhole = 0.2;
constexpr double CoreFraction = 0.02; // c / b: below, the root is too steep for a step

// Force that lifts a plate from a plane in a wind along it (coefficient 1) over that which lets it
// settle (1.2): loose plates take off at about the speed at which they settle.
constexpr double LiftRatio = 0.8;
constexpr double MostLift = 2.5; // it rises by no more than 1.5 of the speed with which it settles
constexpr double BearingTime = 0.1; // s
constexpr double LiftTime = 0.6;    // s

constexpr double BearingGap = 0.01;   // m, above the clearance
constexpr double BearingReach = 0.5;  // of the clearance, over which f comes to 0
constexpr double BearingNormal = 0.8; // least z of the normal, 37 degrees

} // namespace

GroundEffect::GroundEffect(const ObstacleSet& obstacles, const std::vector<LandingWindow>& landings,
                           const MotionObject& body, double framesPerSecond, const AirAt& air) :
  Obstacles(&obstacles),
  FramesPerSecond(framesPerSecond), RestHeight(body.RestHeight),
  Height(2.0 / M_PI * LandingCushionTime * LawOf(body).SettlingSpeed()),
  Length(2.0 * body.ClearanceRadius)
{
  const double settling = LawOf(body).SettlingSpeed();
  if (settling <= 0.0)
  {
    return;
  }
  for (const LandingWindow& landing : landings)
  {
    const double down = landing.Frame;
    this->Times.push_back({ landing.ObstacleId,
                            down - CushionBegins * framesPerSecond,
                            down,
                            (CushionBegins - CushionIsWhole) * framesPerSecond,
                            landing.Point,
                            {} });
    if (!air || this->Length <= 0.0)
    {
      continue;
    }
    Near rise{
      landing.ObstacleId, static_cast<double>(landing.Until), 0.0, 0.0, landing.Point, {}
    };
    const double frames = LiftTime * framesPerSecond;
    for (int f = 0; f <= static_cast<int>(frames) + 1; ++f)
    {
      const int frame = landing.Until + f;
      const Vec3 above = landing.Centre.At(frame) + this->Length * landing.Normal;
      const Vec3 surface = landing.Centre.Velocity(frame, framesPerSecond);
      const double speeds = (air(above, frame) - surface).squaredNorm();
      const double lift = std::min(MostLift, LiftRatio * speeds / (settling * settling));
      const double borne = 1.0 - SmoothStep(f / (BearingTime * framesPerSecond));
      rise.Lift.push_back((1.0 - SmoothStep(f / frames)) * (borne + (1.0 - borne) * lift));
    }
    rise.Last = rise.First + static_cast<double>(rise.Lift.size()) - 1.0;
    this->Times.push_back(std::move(rise));
  }
}

const GroundEffect::Near* GroundEffect::NearAt(double frame) const
{
  const auto near =
    std::find_if(this->Times.begin(), this->Times.end(),
                 [&](const Near& n) { return frame >= n.First && frame <= n.Last; });
  return near != this->Times.end() ? &*near : nullptr;
}

bool GroundEffect::Brakes(const Vec3& x, double frame) const
{
  const Near* near = this->NearAt(frame);
  Vec3 normal;
  return near != nullptr && near->Lift.empty() &&
         this->HeightAbove(*near, x, frame, normal) < this->Height;
}

double GroundEffect::HeightAbove(const Near& near, const Vec3& x, double frame, Vec3& normal) const
{
  const double reach = near.Lift.empty() ? this->Height : this->Length;
  SurfaceHit hit;
  const double distance =
    this->Obstacles->SignedDistanceTo(near.ObstacleId, x, frame, this->RestHeight + reach, hit);
  normal = hit.Normal;
  return hit.ObstacleId < 0 ? 1e30 : distance - this->RestHeight;
}

double GroundEffect::Landing(const Near& near, double height, double frame, double& slope) const
{
  if (height >= this->Height)
  {
    return 1.0;
  }
  const double core = CoreFraction * this->Height;
  const double r = (std::max(0.0, height) + core) / (this->Height + core);
  const double factor = std::sqrt(2.0 * r - r * r);
  const double share = SmoothStep((frame - near.First) / near.Growth);
  slope = height > 0.0 ? share * (1.0 - r) / factor / (this->Height + core) : 0.0;
  return 1.0 - share * (1.0 - factor);
}

double GroundEffect::Lifting(const Near& near, double height, double frame, double& slope) const
{
  if (height >= this->Length)
  {
    return 1.0;
  }
  const double after = frame - near.First;
  const auto low = std::min(static_cast<std::size_t>(after), near.Lift.size() - 2);
  const double part = after - static_cast<double>(low);
  const double lift = (1.0 - part) * near.Lift[low] + part * near.Lift[low + 1];
  const double r = std::max(0.0, height) / this->Length;
  slope = 6.0 * lift * r * (1.0 - r) / this->Length;
  return 1.0 - lift * (1.0 - CubicStep(r));
}

Vec3 GroundEffect::Carried(const Vec3& x, double frame, Mat3* gradient) const
{
  const Near* near = this->NearAt(frame);
  if (near == nullptr || !near->Surface.IsMoving())
  {
    return Vec3::Zero();
  }
  Vec3 normal;
  const double height = this->HeightAbove(*near, x, frame, normal);
  double slope = 0.0, share = 0.0;
  if (near->Lift.empty())
  {
    share = 1.0 - this->Landing(*near, height, frame, slope);
    slope = -slope;
  }
  else if (height < this->Length)
  {
    const double after = (frame - near->First) / std::max(near->Last - near->First, 1.0);
    const double r = std::max(0.0, height) / this->Length;
    const double kept = 1.0 - SmoothStep(after);
    share = kept * (1.0 - CubicStep(r));
    slope = -kept * 6.0 * r * (1.0 - r) / this->Length;
  }
  const Vec3 velocity = near->Surface.Velocity(frame, this->FramesPerSecond);
  const Vec3 along = velocity - velocity.dot(normal) * normal;
  if (gradient != nullptr)
  {
    *gradient += slope * along * normal.transpose();
  }
  return share * along;
}

double GroundEffect::Bearing(const Vec3& x, double frame, Vec3* gradient) const
{
  const double low = 0.5 * this->Length + BearingGap;
  const double reach = BearingReach * 0.5 * this->Length;
  if (this->Length <= 0.0)
  {
    return 1.0;
  }
  SurfaceHit hit;
  const double distance = this->Obstacles->SignedDistance(x, frame, low + reach, hit);
  const double r = std::max(0.0, distance - low) / reach;
  if (r >= 1.0 || hit.Normal.z() < BearingNormal)
  {
    return 1.0;
  }
  if (gradient != nullptr)
  {
    *gradient = 6.0 * r * (1.0 - r) / reach * hit.Normal;
  }
  return CubicStep(r);
}

double GroundEffect::Factor(const Vec3& x, double frame, Vec3* gradient) const
{
  if (gradient != nullptr)
  {
    gradient->setZero();
  }
  const Near* near = this->NearAt(frame);
  if (near == nullptr && frame >= this->Borne)
  {
    return this->Bearing(x, frame, gradient);
  }
  if (near == nullptr)
  {
    return 1.0;
  }
  Vec3 normal;
  const double height = this->HeightAbove(*near, x, frame, normal);
  double slope = 0.0;
  const double factor = near->Lift.empty() ? this->Landing(*near, height, frame, slope)
                                           : this->Lifting(*near, height, frame, slope);
  if (gradient != nullptr)
  {
    *gradient = slope * normal;
  }
  return factor;
}

} // namespace waft
