// SPDX-License-Identifier: BSD-3-Clause
// A path, one position a frame, that is moved out of what it comes too near to.
#pragma once

#include "Constraints/Rest.h"
#include "Obstacles/ObstacleSet.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace waft
{

/// What the path of an object keeps clear of from each frame to the next: obstacles, walls and
/// ground; around a landing its surface counts by the RestHeight (Rest.h).
struct PathClearance
{
  const ObstacleSet& Obstacles;
  const Box& Volume;
  const std::vector<LandingWindow>& Landings;
  ClearanceRule Rule;
  double Slack = 0.0; // m: a path that is nearer by less counts as clear

  /// Frames k from which the way to k + 1 is not clear.
  std::vector<std::size_t> BlockedSteps(const std::vector<Vec3>& path) const;
  /// The way out to all that is asked for at a frame, zero where it is kept [m].
  Vec3 Lacking(const Vec3& x, double frame) const;
};

/// In what way a path may be changed.
struct PathFreedom
{
  std::vector<double> Weights; // by frame, of changes: 1, less towards what stays, 0: stays
  double FrameStep = 1.0;      // s
  /// Brings a path that was changed back to all that it is to meet exactly.
  std::function<void(std::vector<Vec3>&)> MeetRows;
};

/// Where the path is not clear it is moved away from the obstacles, smoothly in time, and where
/// that is not enough it goes back to `fallback`, a path that is clear, without a jump of speed.
/// True when the path is clear then.
bool ResolveClearance(const PathClearance& clearance, const PathFreedom& freedom,
                      const std::vector<Vec3>& fallback, std::vector<Vec3>& path);

} // namespace waft
