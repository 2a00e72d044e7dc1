// SPDX-License-Identifier: BSD-3-Clause
// What bodies do each by itself, divided over threads and ranks.
#pragma once

#include "Air/Run/AirElsewhere.h"
#include "Air/Run/AirState.h"
#include "Base/SharedWork.h"

#include <vector>

namespace waft
{

enum class BodyTask
{
  Seek,  // SeekPath
  Drift, // SolveDrift from its path on
  Land   // what nothing asks for any more and sinks to a surface lies there to the end
};

/// Those of `which` that an edit does not leave as they were. iterations: of Drift. Stopped, some
/// have done nothing.
Result EachBody(const AirContext& run, const HalfSeries& series, BodyTask task, int iterations,
                const std::vector<char>& which, AirBodies& bodies, PartMonitor& monitor);

inline constexpr const char* BodiesKind = "bodies";
/// Does so for rank 0. atOnce: threads of parallel.
Result ServeBodies(ReadingStream& inputs, SharedItems& items, int atOnce,
                   const ParallelFor& parallel, AirElsewhere& elsewhere);

} // namespace waft
