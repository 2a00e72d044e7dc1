// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Base/Mesh.h"

#include <vector>

namespace waft
{

/// How often a closed part of a mesh, these triangles of it, winds about x (Van Oosterom and
/// Strackee 1983): 0 outside, 1 or -1 inside.
double WindingNumber(const TriangleMesh& mesh, const std::vector<int>& triangles, const Vec3& x);

} // namespace waft
