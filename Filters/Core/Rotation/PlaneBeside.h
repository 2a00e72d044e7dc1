// SPDX-License-Identifier: BSD-3-Clause
// The plane that stands for a surface which a body passes.
#pragma once

#include "Obstacles/ObstacleSet.h"

#include <vector>

namespace waft
{

/// A body on its way past a surface at a frame.
struct PassingBody
{
  const std::vector<Vec3>* Points = nullptr; // in its axes
  double Reach = 0.0;                        // m, of them about its centre
  Quat Orientation = Quat::Identity();
  double Frame = 0.0;
  Vec3 Center = Vec3::Zero();
  Vec3 Before = Vec3::Zero(); // where the centre came from, as seen from the surface
};

/// A flat surface lies below the plane that touches it at the point nearest to a body's centre, and
/// what is above that plane does not cut the surface. About an edge many planes are like that. The
/// one of the nearest point turns by up to a right angle as a centre passes the edge, however near
/// or far: a body that has to turn along pops. This is, where the body is below the nearest one,
/// the one of them that it is highest above on its way: touching the surface where it is nearest to
/// points about the body's own normal.
SurfaceHit PlaneBeside(const ObstacleSet& obstacles, const SurfaceHit& nearest,
                       const PassingBody& body);

} // namespace waft
