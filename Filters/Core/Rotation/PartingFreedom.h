// SPDX-License-Identifier: BSD-3-Clause
// What of a finished flight may be changed, so that its rows stay met.
#pragma once

#include "Rotation/RotationRefine.h"

#include <vector>

namespace waft
{

/// By how much of a change a body's pose and place may take part in it, by frame: 0, where they are
/// given, to 1, smoothly.
struct PartingFreedom
{
  std::vector<double> Turn, Shift;
};

/// rows: those of all bodies, rests with the frame of their first contact; places: of the body's.
PartingFreedom FreedomOf(const MotionObject& object, const std::vector<Constraint>& rows,
                         const std::vector<std::size_t>& places, const Timeline& time);

/// A body at a frame as it is, and as it might be.
struct ChangedBody
{
  const MotionObject* Object = nullptr;
  const Shape* Body = nullptr;
  double Radius = 0.0; // m, of its mesh about its centre
  int Frame = 0;
  Vec3 Before = Vec3::Zero(), After = Vec3::Zero();
  Quat Pose = Quat::Identity(); // after
};

/// Whether the balls of its rows and its clearance are kept, and no vertex is below a surface.
/// places: of the body's rows in the input's.
bool IsAllowed(const RotationInput& input, const std::vector<std::size_t>& places,
               const ChangedBody& changed);

} // namespace waft
