// SPDX-License-Identifier: BSD-3-Clause
// Who goes where of single rows that any object may fulfil: the best of all ways together.
#pragma once

#include "Planning/TargetStops.h"

#include <cstddef>
#include <vector>

namespace waft
{

/// A stretch of an object's time line between two positions that are fixed.
struct FlightGap
{
  std::size_t Object = 0;
  Stop From;
  Stop To;
  bool IsOpen = true; // no position is fixed after it
};

/// Those that a target is within. stops: the positions that each object is fixed to, in order of
/// time, its start first.
std::vector<FlightGap> CollectGaps(const std::vector<MotionObject>& objects,
                                   const std::vector<std::vector<Stop>>& stops,
                                   const std::vector<TargetStops>& targets);

/// By target the index of an object, NoObject where it is left over. Time and memory grow with the
/// square of targets and gaps.
std::vector<std::size_t> CoverTogether(const std::vector<MotionObject>& objects,
                                       const std::vector<TargetStops>& targets,
                                       const std::vector<FlightGap>& gaps, const SpeedLimit& limit);

} // namespace waft
