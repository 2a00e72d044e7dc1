// SPDX-License-Identifier: BSD-3-Clause
// What colours bodies have where nothing can show their textures.
#pragma once

#include "Base/Shape.h"

#include <array>
#include <vector>

namespace waft
{

/// Red, green and blue (0..1, as a screen is told) at each point of a shape's mesh: its texture
/// there times its tint, or its plain colour where it has no texture that can be read. A point that
/// the texture cuts away has the mean of what it leaves.
std::vector<std::array<double, 3>> ColorsOfPoints(const Shape& shape);

} // namespace waft
