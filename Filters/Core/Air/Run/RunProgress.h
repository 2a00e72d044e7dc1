// SPDX-License-Identifier: BSD-3-Clause
// How far a run is, part by part.
#pragma once

#include <algorithm>

namespace waft
{

inline constexpr double DrawEnd = 0.25; // of a run, about
inline constexpr double DriftEnd = 0.4;
inline constexpr double WindEnd = 0.15; // of a round, about
inline constexpr double SimulationEnd = 0.85;
inline constexpr double DriftingEnd = 0.92;

/// Where a round begins, and a fraction of it is done, in the progress of a run.
inline double ProgressOf(int rounds, int round, double fraction)
{
  return DriftEnd + (round + fraction) * (1.0 - DriftEnd) / std::max(1, rounds);
}

} // namespace waft
