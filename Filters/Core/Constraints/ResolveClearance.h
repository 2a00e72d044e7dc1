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

/// Near a mark that itself lies closer to something than the radius, only the mark's own clearance
/// can be asked for.
struct TightMark
{
  Vec3 Position = Vec3::Zero();
  double Distance = 0.0; // its clearance [m]
};

/// What a rule asks for on the way from a to b [m]: its radius, less next to tight marks.
double Required(const ClearanceRule& rule, const std::vector<TightMark>& tight, const Vec3& a,
                const Vec3& b);

/// What the path of an object keeps clear of from each frame to the next: obstacles, walls and
/// ground; around a landing its surface counts by the RestHeight (Rest.h).
struct PathClearance
{
  const ObstacleSet& Obstacles;
  FlightRoom Around;
  const std::vector<LandingWindow>& Landings;
  ClearanceRule Rule;
  double Slack = 0.0; // m: a path that is nearer by less counts as clear
  std::vector<TightMark> TightMarks = {};

  /// What holds on the way from a to b, the slack taken off.
  ClearanceRule RuleOn(const Vec3& a, const Vec3& b) const;
  /// Frames k from which the way to k + 1 is not clear.
  std::vector<std::size_t> BlockedSteps(const std::vector<Vec3>& path) const;
  /// By frame, the way out to all that is asked for, of a path whose `blocked` steps are not clear
  /// [m].
  std::vector<Vec3> Lacking(const std::vector<Vec3>& path,
                            const std::vector<std::size_t>& blocked) const;
};

/// In what way a path may be changed.
struct PathFreedom
{
  std::vector<double> Weights; // by frame, of changes: 1, less towards what stays, 0: stays
  double FrameStep = 1.0;      // s
  /// Brings a path that was changed back to all that it is to meet exactly.
  std::function<void(std::vector<Vec3>&)> MeetRows;
  int Rounds = 8;      // of pushing
  double Beyond = 0.0; // m, pushed farther than what is asked for
  int Reach = 15;      // frames to either side over which a push comes and goes
  /// Takes up pushes, one a frame [m]. None: each frame is moved by its weight.
  std::function<void(const std::vector<Vec3>& pushes, std::vector<Vec3>& path)> Yield = {};
};

/// Where the path is not clear it is moved away from the obstacles, smoothly in time, and where
/// that is not enough it goes back to `fallback`, a path that is clear, without a jump of speed.
/// True when the path is clear then.
bool ResolveClearance(const PathClearance& clearance, const PathFreedom& freedom,
                      const std::vector<Vec3>& fallback, std::vector<Vec3>& path);

} // namespace waft
