// SPDX-License-Identifier: BSD-3-Clause
#include "Base/ShapeMeasures.h"

namespace waft
{

double SurfaceArea(const TriangleMesh& mesh)
{
  double area = 0.0;
  for (const auto& t : mesh.Triangles)
  {
    const Vec3& a = mesh.Points[t[0]];
    area += 0.5 * (mesh.Points[t[1]] - a).cross(mesh.Points[t[2]] - a).norm();
  }
  return area;
}

Vec3 ShellCentroid(const TriangleMesh& mesh)
{
  Vec3 moment = Vec3::Zero();
  double total = 0.0;
  for (const auto& t : mesh.Triangles)
  {
    const Vec3& a = mesh.Points[t[0]];
    const Vec3& b = mesh.Points[t[1]];
    const Vec3& c = mesh.Points[t[2]];
    const double area = 0.5 * (b - a).cross(c - a).norm();
    moment += area / 3.0 * (a + b + c);
    total += area;
  }
  if (total > 0.0)
  {
    return moment / total;
  }
  for (const Vec3& p : mesh.Points)
  {
    moment += p;
  }
  return mesh.Points.empty() ? moment : Vec3(moment / static_cast<double>(mesh.Points.size()));
}

double LargestExtent(const TriangleMesh& mesh)
{
  if (mesh.Points.empty())
  {
    return 0.0;
  }
  Vec3 low = mesh.Points.front();
  Vec3 high = low;
  for (const Vec3& p : mesh.Points)
  {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).maxCoeff();
}

void CenterOnMass(TriangleMesh& mesh)
{
  const Vec3 center = ShellCentroid(mesh);
  for (Vec3& p : mesh.Points)
  {
    p -= center;
  }
}

void ScaleToExtent(double size, TriangleMesh& mesh)
{
  const double extent = LargestExtent(mesh);
  for (Vec3& p : mesh.Points)
  {
    p *= extent > 0.0 ? size / extent : 1.0;
  }
}

double ShellMass(const Shape& shape)
{
  return shape.AreaDensity * SurfaceArea(shape.Mesh);
}

double ClearanceRadius(const Shape& shape)
{
  return 0.5 * LargestExtent(shape.Mesh);
}

double RestHeight(const Shape& shape)
{
  double lowest = 0.0;
  for (const Vec3& p : shape.Mesh.Points)
  {
    lowest = std::min(lowest, p.z());
  }
  return -lowest;
}

} // namespace waft
