// SPDX-License-Identifier: BSD-3-Clause
#include "Base/MeshNormals.h"

namespace waft
{

std::vector<Vec3> SmoothNormals(const TriangleMesh& mesh)
{
  std::vector<Vec3> normals(mesh.Points.size(), Vec3::Zero());
  for (const auto& t : mesh.Triangles)
  {
    const Vec3 area =
      (mesh.Points[t[1]] - mesh.Points[t[0]]).cross(mesh.Points[t[2]] - mesh.Points[t[0]]);
    for (const int corner : t)
    {
      normals[corner] += area;
    }
  }
  for (Vec3& normal : normals)
  {
    const double length = normal.norm();
    normal = length > 0.0 ? Vec3(normal / length) : Vec3(Vec3::UnitZ());
  }
  return normals;
}

} // namespace waft
