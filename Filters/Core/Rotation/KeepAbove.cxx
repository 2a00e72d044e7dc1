// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/KeepAbove.h"

#include "Base/NumberText.h"
#include "Base/SpreadPushes.h"
#include "Rotation/PlaneBeside.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{
constexpr double LeastReported = 1e-5; // m: a centre that was moved by less is seen by nobody

/// A shift of one frame comes and goes smoothly in the frames around, the largest counts. Lying
/// bodies and landing ones stay where they are, and where rows hold the centre there is none.
std::vector<Vec3> Spread(const std::vector<Vec3>& own, int reach, const FrameMarks& marks)
{
  std::vector<Vec3> spread = SpreadPushes(own, reach);
  for (std::size_t k = 0; k < spread.size(); ++k)
  {
    if (marks.Frames[k].Freedom == PoseFreedom::Fixed || marks.Landing[k] != 0)
    {
      spread[k] = own[k];
    }
    if (marks.Held[k] != 0)
    {
      spread[k].setZero();
    }
  }
  return spread;
}

/// How far an obstacle goes from a frame to the next.
Vec3 Moved(const ObstacleSet& obstacles, int obstacleId, int frame)
{
  const ObstacleMesh* found = obstacles.Find(obstacleId);
  return found->Offset(frame + 1.0) - found->Offset(frame);
}
} // namespace

bool FindFloor(const AttitudePlan& plan, int frame, double step, const Quat* passing, Floor& floor)
{
  if (plan.Obstacles == nullptr)
  {
    return false;
  }
  const double reach = plan.BoundingRadius;
  const std::vector<Vec3>& places = plan.Path->Positions;
  const auto height = [&](int k)
  { return plan.Obstacles->SignedDistance(places[k], k, 2.0 * reach); };
  const double after = height(frame + 1);
  floor.Height = height(frame);
  if (std::min(floor.Height, after) >= reach)
  {
    return false;
  }
  floor.Points = &plan.Body->Mesh.Points;
  floor.Rate = (after - floor.Height) / step;
  SurfaceHit hit;
  plan.Obstacles->SignedDistance(places[frame + 1], frame + 1, hit);
  floor.Normal = hit.Normal;
  if (passing != nullptr)
  {
    PassingBody body{
      floor.Points, reach, *passing, frame + 1.0, places[frame + 1], places[frame]
    };
    body.Before += Moved(*plan.Obstacles, hit.ObstacleId, frame);
    const SurfaceHit plane = PlaneBeside(*plan.Obstacles, hit, body);
    if (plane.Normal != hit.Normal)
    {
      floor.Normal = plane.Normal;
      floor.Height = (body.Before - plane.Point).dot(plane.Normal);
      floor.Rate = (body.Center - body.Before).dot(plane.Normal) / step;
    }
  }
  return true;
}

void KeepAbove(const AttitudePlan& plan, FrameMarks& marks, AttitudeOutcome& out)
{
  const double fps = plan.Time.FramesPerSecond;
  const std::string name = "object " + std::to_string(plan.Object->ObjectId);
  marks.Shifts = Spread(marks.Shifts, static_cast<int>(0.5 * plan.LandingTime * fps), marks);
  const std::vector<Vec3> before = marks.Shifts;
  std::vector<Vec3> positions = plan.Path->Positions;
  for (std::size_t k = 0; k < positions.size(); ++k)
  {
    positions[k] += before[k];
  }
  ContactInput contact;
  contact.Mesh = &plan.Body->Mesh;
  contact.BoundingRadius = plan.BoundingRadius;
  contact.Positions = &positions;
  contact.Frames = &marks.Frames;
  contact.Obstacles = plan.Obstacles;
  contact.SmoothingFrames = std::max(1, static_cast<int>(std::lround(0.12 * fps)));
  contact.MostShift = plan.Tolerance;
  const double deepest =
    KeepAboveSurfaces(contact, out.Poses.Orientations, marks.Changed, marks.Shifts);
  std::vector<Vec3> further = marks.Shifts;
  for (std::size_t k = 0; k < further.size(); ++k)
  {
    further[k] -= before[k];
  }
  further = Spread(further, contact.SmoothingFrames, marks);
  double farthest = marks.Moved;
  bool isShifted = false;
  for (std::size_t k = 0; k < further.size(); ++k)
  {
    marks.Shifts[k] = before[k] + further[k];
    farthest = std::max(farthest, further[k].norm());
    isShifted = isShifted || !marks.Shifts[k].isZero(0.0);
  }
  if (deepest > plan.Tolerance)
  {
    out.Warnings.push_back(name + ": its mesh lies up to " + NumberText(deepest, 3) +
                           " m below a surface, as its centre comes too near");
  }
  if (isShifted)
  {
    out.Shifts = marks.Shifts;
  }
  if (farthest > LeastReported)
  {
    out.Warnings.push_back(name + ": its centre was moved by up to " + NumberText(farthest, 3) +
                           " m so that its mesh touches the surface and does not cut it");
  }
}

} // namespace waft
