// SPDX-License-Identifier: BSD-3-Clause
// Points that are one: readers split them at seams of texture or normals.
#pragma once

#include "Base/Types.h"

#include <vector>

namespace waft
{

/// Of each point the first that is equal to it.
std::vector<int> EqualPoints(const std::vector<Vec3>& points);

/// Of each point the first that is nearer to it than the tolerance [m].
std::vector<int> NearPoints(const std::vector<Vec3>& points, double tolerance);

/// What a seam that should close may gape, by rounding [m]: 1e-9 of the points' diagonal, and no
/// less than what double precision tells apart there.
double SeamTolerance(const std::vector<Vec3>& points);

} // namespace waft
