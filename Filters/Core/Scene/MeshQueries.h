// SPDX-License-Identifier: BSD-3-Clause
// What the starts of a scene's objects ask of its meshes.
#pragma once

#include "Obstacles/TriangleTree.h"

namespace waft
{

/// True when a ball lies wholly outside the solid.
bool IsOutside(const TriangleTree& solid, const Vec3& center, double radius);

} // namespace waft
