// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/MeshQueries.h"

#include <cmath>

namespace waft
{

Box BoundsOf(const TriangleMesh& mesh)
{
  Box box{ Vec3::Constant(HUGE_VAL), Vec3::Constant(-HUGE_VAL) };
  for (const Vec3& p : mesh.Points)
  {
    box.Min = box.Min.cwiseMin(p);
    box.Max = box.Max.cwiseMax(p);
  }
  return box;
}

bool IsOutside(const TriangleTree& solid, const Vec3& center, double radius)
{
  return !solid.IsInside(center) && solid.ClosestPoint(center, radius * radius).Triangle < 0;
}

} // namespace waft
