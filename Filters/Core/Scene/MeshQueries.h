// SPDX-License-Identifier: BSD-3-Clause
// What the starts of a scene's objects ask of its meshes.
#pragma once

#include "Base/Mesh.h"
#include "Obstacles/TriangleTree.h"

namespace waft
{

/// The box around all points.
Box BoundsOf(const TriangleMesh& mesh);

/// True when a ball lies wholly outside the solid.
bool IsOutside(const TriangleTree& solid, const Vec3& center, double radius);

} // namespace waft
