// SPDX-License-Identifier: BSD-3-Clause
// Makes a triangle list a closed, outwards oriented surface, or says why it cannot be one.
#pragma once

#include "Base/Mesh.h"
#include "Base/Result.h"

#include <string>

namespace waft
{

/// Welds equal points (readers split them at seams of texture or normals), turns triangles that
/// disagree with their neighbours, then whole connected components: outermost ones face outwards, a
/// component inside an odd number of others bounds a cavity and faces into it. Errors (each names
/// `name` and a place): no triangle, an index out of range, a number that is not finite, an edge
/// that does not belong to exactly two triangles, a one-sided surface.
Result RepairSurface(const std::string& name, TriangleMesh& mesh);

/// Fails when two triangles of a welded surface meet elsewhere than along shared edges and
/// vertices; decided by exact predicates. Triangles without area are skipped.
Result CheckSelfIntersection(const std::string& name, const TriangleMesh& mesh);

} // namespace waft
