// SPDX-License-Identifier: BSD-3-Clause
// How far a run is, part by part.
#pragma once

namespace waft
{

inline constexpr double DrawEnd = 0.08; // of a run that simulates its air again, about
inline constexpr double DriftEnd = 0.2;
inline constexpr double WindEnd = 0.45;
inline constexpr double SimulationEnd = 0.75;
inline constexpr double SeekingEnd = 0.8;

} // namespace waft
