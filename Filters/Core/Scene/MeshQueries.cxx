// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/MeshQueries.h"

namespace waft
{

bool IsOutside(const TriangleTree& solid, const Vec3& center, double radius)
{
  return !solid.IsInside(center) && solid.ClosestPoint(center, radius * radius).Triangle < 0;
}

} // namespace waft
