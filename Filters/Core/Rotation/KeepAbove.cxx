// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/KeepAbove.h"

#include "Base/NumberText.h"
#include "Base/SpreadPushes.h"

#include <cmath>

namespace waft
{
namespace
{
constexpr double LeastReported = 1e-5; // m: a centre that was moved by less is seen by nobody

/// A shift of one frame comes and goes smoothly in the frames around, the largest counts; where
/// rows hold the centre there is none.
void SpreadShifts(int reach, FrameMarks& marks)
{
  const std::vector<Vec3> spread = SpreadPushes(marks.Shifts, reach);
  for (std::size_t k = 0; k < spread.size(); ++k)
  {
    if (marks.Frames[k].Freedom != PoseFreedom::Fixed)
    {
      marks.Shifts[k] = spread[k];
    }
    if (marks.Held[k] != 0)
    {
      marks.Shifts[k].setZero();
    }
  }
}
} // namespace

void KeepAbove(const AttitudePlan& plan, FrameMarks& marks, AttitudeOutcome& out)
{
  const double fps = plan.Time.FramesPerSecond;
  const std::string name = "object " + std::to_string(plan.Object->ObjectId);
  SpreadShifts(static_cast<int>(0.5 * plan.LandingTime * fps), marks);
  std::vector<Vec3> positions = plan.Path->Positions;
  for (std::size_t k = 0; k < positions.size(); ++k)
  {
    positions[k] += marks.Shifts[k];
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
  double farthest = 0.0;
  SpreadShifts(contact.SmoothingFrames, marks);
  for (const Vec3& shift : marks.Shifts)
  {
    farthest = std::max(farthest, shift.norm());
  }
  if (deepest > plan.Tolerance)
  {
    out.Warnings.push_back(name + ": its mesh lies up to " + NumberText(deepest, 3) +
                           " m below a surface, as its centre comes too near");
  }
  if (farthest > 0.0)
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
