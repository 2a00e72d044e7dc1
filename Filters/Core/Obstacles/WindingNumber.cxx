// SPDX-License-Identifier: BSD-3-Clause
#include "Obstacles/WindingNumber.h"

#include <cmath>

namespace waft
{

double WindingNumber(const TriangleMesh& mesh, const std::vector<int>& triangles, const Vec3& x)
{
  double sum = 0.0;
  for (const int t : triangles)
  {
    const Vec3 a = mesh.Points[mesh.Triangles[t][0]] - x;
    const Vec3 b = mesh.Points[mesh.Triangles[t][1]] - x;
    const Vec3 c = mesh.Points[mesh.Triangles[t][2]] - x;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    sum +=
      std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return static_cast<double>(sum / (2.0 * EIGEN_PI));
}

} // namespace waft
