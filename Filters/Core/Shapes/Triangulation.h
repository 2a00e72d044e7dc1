// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Base/Result.h"
#include "Shapes/AlphaOutline.h"

#include <array>
#include <vector>

namespace waft
{

/// Fills a simple polygon with triangles, counter-clockwise, no side longer than `size` and, where
/// the outline allows, no angle below 20 degrees (Shewchuk 2002): a constrained Delaunay mesh.
/// Fails when the polygon crosses itself or has no area.
Result TriangulatePolygon(const Polygon& polygon, double size,
                          std::vector<std::array<double, 2>>& points,
                          std::vector<std::array<int, 3>>& triangles);

} // namespace waft
