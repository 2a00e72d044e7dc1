// SPDX-License-Identifier: BSD-3-Clause
// The middle lines of strokes in a raster.
#pragma once

#include <vector>

namespace waft
{

/// Thins a raster of 0 and 1 (x fastest) to lines one pixel wide (Zhang and Suen 1984).
std::vector<char> ThinStrokes(std::vector<char> raster, int width, int height);

} // namespace waft
