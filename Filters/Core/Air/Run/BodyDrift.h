// SPDX-License-Identifier: BSD-3-Clause
// All bodies in the air as it is. What an edit leaves as it was does not move.
#pragma once

#include "Air/Run/AirState.h"

#include <vector>

namespace waft
{

/// Each by a search (SeekPath).
Result SeekPaths(const AirContext& run, const HalfSeries& air, const std::vector<char>& which,
                 AirBodies& bodies, PartMonitor& monitor);
/// Those whom the air as it has become does not take to their marks.
Result SeekAgain(const AirContext& run, const HalfSeries& air, AirBodies& bodies,
                 PartMonitor& monitor);

/// Each from its path on, beside the others as they are. Stopped, some have not drifted.
Result DriftOn(const AirContext& run, const HalfSeries& air, int iterations, AirBodies& bodies,
               Monitor& monitor);

/// What nothing asks for any more and sinks to a surface lies there to the end.
Result LandFreeBodies(const AirContext& run, const HalfSeries& air, AirBodies& bodies);

/// Those that are too near to each other give way together, pass by pass harder.
void KeepApart(const AirContext& run, const HalfSeries& air, AirBodies& bodies);

/// Exactly to the marks, and clear of what is in the way. By body: whether it keeps its clearance.
std::vector<char> FinishPaths(const AirContext& run, const HalfSeries& air, AirBodies& bodies);

} // namespace waft
