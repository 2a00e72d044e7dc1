// SPDX-License-Identifier: BSD-3-Clause
#include "Base/ShapeMeasures.h"

#include <algorithm>
#include <map>
#include <utility>

namespace waft
{
namespace
{
constexpr double LightestSolid = 0.01; // kg/m^2
constexpr double FilmOpacity = 0.35;

/// Has it no area, but for what single precision cannot tell from none?
bool HasNoArea(const Vec3& a, const Vec3& b, const Vec3& c)
{
  constexpr double thinnest = 1e-6; // height in parts of the longest side
  const double longest =
    std::max({ (b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm() });
  return (b - a).cross(c - a).norm() <= thinnest * longest;
}
} // namespace

bool IsClosed(const TriangleMesh& mesh)
{
  std::map<std::pair<int, int>, int> sides;
  for (const auto& t : mesh.Triangles)
  {
    for (int i = 0; i < 3; ++i)
    {
      ++sides[std::minmax({ t[i], t[(i + 1) % 3] })];
    }
  }
  return !sides.empty() &&
         std::all_of(sides.begin(), sides.end(), [](const auto& side) { return side.second == 2; });
}

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

std::string RemarkOnFlatTriangles(const TriangleMesh& mesh)
{
  const auto flat =
    std::count_if(mesh.Triangles.begin(), mesh.Triangles.end(),
                  [&](const std::array<int, 3>& t)
                  { return HasNoArea(mesh.Points[t[0]], mesh.Points[t[1]], mesh.Points[t[2]]); });
  return flat == 0
           ? ""
           : std::to_string(flat) + " of " + std::to_string(mesh.Triangles.size()) + " triangles " +
               (flat == 1 ? "has" : "have") + " no area; neither weight nor air counts there";
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
  return mesh.Points.empty() ? 0.0 : BoxAbout(mesh.Points).Size().maxCoeff();
}

Vec3 EllipsoidAbout(const TriangleMesh& mesh)
{
  constexpr double thinnest = 0.1; // of the longest half axis
  Vec3 half = Vec3::Zero();
  for (const Vec3& p : mesh.Points)
  {
    half = half.cwiseMax(p.cwiseAbs());
  }
  half = half.cwiseMax(thinnest * half.maxCoeff());
  double farthest = 0.0; // of the points, in half axes
  for (const Vec3& p : mesh.Points)
  {
    farthest = half.minCoeff() > 0.0 ? std::max(farthest, p.cwiseQuotient(half).norm()) : 0.0;
  }
  return farthest * half;
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

double Opacity(const Shape& shape)
{
  return shape.AreaDensity < LightestSolid && IsClosed(shape.Mesh) ? FilmOpacity : 1.0;
}

} // namespace waft
