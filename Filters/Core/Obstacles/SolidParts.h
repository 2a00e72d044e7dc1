// SPDX-License-Identifier: BSD-3-Clause
// Several solids in one surface, told apart.
#pragma once

#include "Base/Mesh.h"

#include <vector>

namespace waft
{

/// Of each triangle the solid that it belongs to, from 0 in the order of their first triangles.
/// Triangles that share an edge are of one solid; where more than two meet at an edge (solids that
/// touch along it), they go by twos in their order, which solids that were appended keep. A part
/// inside an odd number of others bounds a cavity, of the one that it is most deeply in. `count`:
/// how many solids there are. Indices have to be in range; surfaces that are open are parts too.
std::vector<int> SolidOfTriangles(const TriangleMesh& mesh, int& count);

} // namespace waft
