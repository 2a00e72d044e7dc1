// SPDX-License-Identifier: BSD-3-Clause
// How a thin body lies on whatever surface is below it.
#pragma once

#include "Base/Mesh.h"
#include "Obstacles/ObstacleSet.h"

namespace waft
{

struct RestingPose
{
  Quat Orientation = Quat::Identity();
  double Shift = 0.0; // m, upwards, of the centre
  double Depth = 0.0; // m, of the deepest vertex that is still below a surface
};

/// Lays a body down that would lie like that on a plane of this normal: the centre is moved up or
/// down, by at most mostShift, until the lowest vertex touches. Where the ground is too rough for
/// that, as it lies on a plane through what is below the body, then leaning away from what it cuts,
/// then, if it may, turned about the normal; the first pose that fits is taken, else the one that
/// cuts least. On a plane the pose is the given one to the bit.
RestingPose LayDown(const TriangleMesh& mesh, const ObstacleSet& obstacles, double frame,
                    const Vec3& center, const Vec3& normal, const Quat& lying, double mostShift,
                    bool mayTurn);

} // namespace waft
