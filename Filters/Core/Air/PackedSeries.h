// SPDX-License-Identifier: BSD-3-Clause
// A series of half floats in about half the bytes, without loss.
#pragma once

#include "Base/HalfSeries.h"
#include "Base/StateArchive.h"

namespace waft
{

/// Moves the values of a series, all times of which have the same number of points. Air changes so
/// evenly that what a value differs from the straight line through the two times before is mostly
/// within a byte; these differences are what is written, by zlib. A stream with anything else is
/// refused.
void SerialisePacked(StateArchive& stream, std::vector<std::vector<Half3>>& values);

} // namespace waft
