// SPDX-License-Identifier: BSD-3-Clause
// A series of half floats in about half the bytes, without loss.
#pragma once

#include "Base/HalfSeries.h"
#include "Base/Parallel.h"
#include "Base/StateArchive.h"

namespace waft
{

/// The values of a series, all times of which have the same number of points. Air changes so
/// evenly that what a value differs from the straight line through the two times before is mostly
/// within a byte; these differences are what is written, low and high bytes apart, by Zstandard.
/// The same bytes on any number of threads.
void WritePacked(StateArchive& stream, const std::vector<std::vector<Half3>>& values,
                 const ParallelFor& parallel = SerialFor());
/// What was written so; a stream with anything else is refused.
void ReadPacked(StateArchive& stream, std::vector<std::vector<Half3>>& values);

} // namespace waft
