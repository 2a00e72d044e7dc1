// SPDX-License-Identifier: BSD-3-Clause
// The classic to compare with: two rapidly-exploring random trees of straight segments, without
// style and without time (Kuffner and LaValle 2000), as OMPL has it.
#pragma once

#include "Base/Types.h"
#include "Obstacles/ObstacleSet.h"

#include <vector>

namespace waft
{

/// Processor seconds that each of a number of runs of OMPL's RRT-Connect takes from start to goal
/// for a ball of this radius; those that find nothing within 10 s are left out. To be called once:
/// OMPL seeds its generators only before the first of them.
std::vector<double> RunRRTConnect(const ObstacleSet& obstacles, const Box& bounds, double radius,
                                  const Vec3& start, const Vec3& goal, int runs);

} // namespace waft
