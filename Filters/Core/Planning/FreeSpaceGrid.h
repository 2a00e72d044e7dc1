// SPDX-License-Identifier: BSD-3-Clause
// A coarse map of where a body of one size fits, to lead the trees through mazes.
#pragma once

#include "Obstacles/ObstacleSet.h"

#include <array>
#include <atomic>
#include <vector>

namespace waft
{

class FreeSpaceGrid
{
public:
  /// Looks at the centres of about `cells` cells along the width of the volume, at most twice as
  /// many along any side; obstacles as they stand at frame 0. clearance: that the body keeps [m].
  /// Stopped half way, the rest counts as full, and no way is found.
  FreeSpaceGrid(const ObstacleSet& obstacles, const Box& bounds, double clearance, int cells,
                const std::atomic<bool>& stop);

  /// A shortest way over the cells from a to b, both included (A*; ends that do not fit themselves,
  /// like positions of rest, are entered from the nearest cell that does). Empty when the map shows
  /// none.
  std::vector<Vec3> FindWay(const Vec3& a, const Vec3& b) const;

private:
  using Cell = std::array<int, 3>;
  std::size_t Index(const Cell& cell) const;
  Vec3 Center(const Cell& cell) const;
  bool NearestFree(const Vec3& x, Cell& cell) const;
  bool IsPassable(const Cell& a, const Cell& b) const;

  const ObstacleSet& Obstacles;
  const std::atomic<bool>& Stop;
  Box Bounds;
  double Clearance = 0.0;
  double Spacing = 0.0;
  Cell Counts{ 1, 1, 1 };
  std::vector<float> Room; // distance to the nearest thing at each centre [m]
};

/// Point at a fraction (0..1) of the length of a polyline.
Vec3 PointAlong(const std::vector<Vec3>& way, double fraction);

} // namespace waft
