// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/Rasteriser.h"

#include <Eigen/Eigenvalues>

#include <array>
#include <cmath>

namespace waft
{
namespace
{
struct Plane2
{
  double U = 0.0;
  double V = 0.0;
};

/// Twice the signed area of (a, b, p). Computed from the lower index on, so that two triangles that
/// share the edge get exactly opposite numbers.
double Edge(const std::vector<Plane2>& points, int a, int b, const Plane2& p)
{
  const bool swapped = a > b;
  const Plane2& from = points[swapped ? b : a];
  const Plane2& to = points[swapped ? a : b];
  const double value = (to.U - from.U) * (p.V - from.V) - (to.V - from.V) * (p.U - from.U);
  return swapped ? -value : value;
}

/// A pixel exactly on an edge belongs to the triangle on one side of it only.
bool OwnsEdge(const std::vector<Plane2>& points, int a, int b)
{
  const double dv = points[b].V - points[a].V;
  return dv > 0.0 || (dv == 0.0 && points[b].U < points[a].U);
}

void ChooseAxes(const TriangleMesh& mesh, RasterView& view)
{
  const Vec3 first = view.Direction.unitOrthogonal();
  const Vec3 second = view.Direction.cross(first);
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const Vec3& point : mesh.Points)
  {
    const Eigen::Vector2d p(first.dot(point), second.dot(point));
    mean += p;
    spread += p * p.transpose();
  }
  const double count = static_cast<double>(mesh.Points.size());
  spread = spread / count - mean * mean.transpose() / (count * count);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(spread);
  const Eigen::Vector2d along = axes.eigenvectors().col(1);
  view.AxisU = (along.x() * first + along.y() * second).normalized();
  view.AxisV = view.Direction.cross(view.AxisU);
}

void FitWindow(const std::vector<Plane2>& points, RasterView& view)
{
  double maxU = points[0].U;
  double maxV = points[0].V;
  view.MinU = maxU;
  view.MinV = maxV;
  for (const Plane2& p : points)
  {
    view.MinU = std::min(view.MinU, p.U);
    view.MinV = std::min(view.MinV, p.V);
    maxU = std::max(maxU, p.U);
    maxV = std::max(maxV, p.V);
  }
  view.StepU = (maxU - view.MinU) / view.Resolution;
  view.StepV = (maxV - view.MinV) / view.Resolution;
}
} // namespace

int RasterView::CoveredPixels() const
{
  int count = 0;
  for (const int id : this->TriangleIds)
  {
    count += id >= 0 ? 1 : 0;
  }
  return count;
}

RasterView Rasterise(const TriangleMesh& mesh, const Vec3& direction, int resolution)
{
  RasterView view;
  view.Direction = direction.normalized();
  view.Resolution = std::max(resolution, 1);
  const std::size_t pixels = static_cast<std::size_t>(view.Resolution) * view.Resolution;
  view.TriangleIds.assign(pixels, -1);
  view.Depths.assign(pixels, -1e300);
  view.Covered.assign(mesh.Triangles.size(), 0);
  view.Visible.assign(mesh.Triangles.size(), 0);
  if (mesh.Points.empty())
  {
    return view;
  }
  ChooseAxes(mesh, view);
  std::vector<Plane2> points(mesh.Points.size());
  std::vector<double> depths(mesh.Points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    points[i] = { view.AxisU.dot(mesh.Points[i]), view.AxisV.dot(mesh.Points[i]) };
    depths[i] = view.Direction.dot(mesh.Points[i]);
  }
  FitWindow(points, view);
  if (!(view.StepU > 0.0 && view.StepV > 0.0))
  {
    return view;
  }
  const auto clampPixel = [&](double x)
  { return static_cast<int>(std::clamp(x, 0.0, static_cast<double>(view.Resolution - 1))); };
  for (std::size_t t = 0; t < mesh.Triangles.size(); ++t)
  {
    std::array<int, 3> v = mesh.Triangles[t];
    double area = Edge(points, v[0], v[1], points[v[2]]);
    if (area < 0.0)
    {
      std::swap(v[1], v[2]);
      area = -area;
    }
    if (!(area > 0.0))
    {
      continue;
    }
    const auto [lowU, highU] = std::minmax({ points[v[0]].U, points[v[1]].U, points[v[2]].U });
    const auto [lowV, highV] = std::minmax({ points[v[0]].V, points[v[1]].V, points[v[2]].V });
    const int i0 = clampPixel(std::floor((lowU - view.MinU) / view.StepU - 0.5));
    const int i1 = clampPixel(std::ceil((highU - view.MinU) / view.StepU - 0.5));
    const int j0 = clampPixel(std::floor((lowV - view.MinV) / view.StepV - 0.5));
    const int j1 = clampPixel(std::ceil((highV - view.MinV) / view.StepV - 0.5));
    const std::array<bool, 3> owns{ OwnsEdge(points, v[1], v[2]), OwnsEdge(points, v[2], v[0]),
                                    OwnsEdge(points, v[0], v[1]) };
    for (int j = j0; j <= j1; ++j)
    {
      for (int i = i0; i <= i1; ++i)
      {
        const Plane2 p{ view.MinU + (i + 0.5) * view.StepU, view.MinV + (j + 0.5) * view.StepV };
        const double e0 = Edge(points, v[1], v[2], p);
        const double e1 = Edge(points, v[2], v[0], p);
        const double e2 = Edge(points, v[0], v[1], p);
        if ((e0 > 0.0 || (e0 == 0.0 && owns[0])) && (e1 > 0.0 || (e1 == 0.0 && owns[1])) &&
            (e2 > 0.0 || (e2 == 0.0 && owns[2])))
        {
          ++view.Covered[t];
          const std::size_t pixel = static_cast<std::size_t>(j) * view.Resolution + i;
          const double depth =
            (e0 * depths[v[0]] + e1 * depths[v[1]] + e2 * depths[v[2]]) / (e0 + e1 + e2);
          if (depth > view.Depths[pixel])
          {
            view.Depths[pixel] = depth;
            view.TriangleIds[pixel] = static_cast<int>(t);
          }
        }
      }
    }
  }
  for (const int id : view.TriangleIds)
  {
    if (id >= 0)
    {
      ++view.Visible[id];
    }
  }
  return view;
}

} // namespace waft
