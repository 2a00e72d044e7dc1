// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Base/Types.h"

#include <vector>

namespace waft
{

/// How one object turns: one sample a frame from frame 0, beside the positions of its Track.
struct PoseTrack
{
  int ObjectId = 0;
  std::vector<Quat> Orientations;      // body to world, unit, no sign flip between frames
  std::vector<Vec3> AngularVelocities; // rad/s, world
  std::vector<Vec3> Torques;           // N m, world, of the air
  std::vector<Vec3> Slips;             // m/s, world, its velocity relative to the air; or empty

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.ObjectId...);
    visit(of.Orientations...);
    visit(of.AngularVelocities...);
    visit(of.Torques...);
    visit(of.Slips...);
  }
};

} // namespace waft
