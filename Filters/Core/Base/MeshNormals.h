// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Base/Mesh.h"

#include <vector>

namespace waft
{

/// Unit normals, one a point: the mean over the triangles around it, weighted by their area. A
/// point without triangles gets +z.
std::vector<Vec3> SmoothNormals(const TriangleMesh& mesh);

} // namespace waft
