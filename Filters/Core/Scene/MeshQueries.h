// SPDX-License-Identifier: BSD-3-Clause
// Distances to a mesh by trying all triangles: enough for the starts of a scene's objects.
#pragma once

#include "Base/Mesh.h"

namespace waft
{

/// The box around all points.
Box BoundsOf(const TriangleMesh& mesh);

/// True when a ball lies wholly outside the closed surface.
bool IsOutside(const TriangleMesh& mesh, const Vec3& center, double radius);

} // namespace waft
