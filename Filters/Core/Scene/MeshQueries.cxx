// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/MeshQueries.h"

#include <cmath>

namespace waft
{

namespace
{

double DistanceToSegment(const Vec3& x, const Vec3& a, const Vec3& b)
{
  const Vec3 ab = b - a;
  const double length2 = ab.squaredNorm();
  const double s = length2 > 0.0 ? std::clamp((x - a).dot(ab) / length2, 0.0, 1.0) : 0.0;
  return (x - a - s * ab).norm();
}

double DistanceToTriangle(const Vec3& x, const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3 normal = (b - a).cross(c - a);
  const double area2 = normal.squaredNorm();
  if (area2 > 0.0 && (b - a).cross(x - a).dot(normal) >= 0.0 &&
      (c - b).cross(x - b).dot(normal) >= 0.0 && (a - c).cross(x - c).dot(normal) >= 0.0)
  {
    return std::abs((x - a).dot(normal)) / std::sqrt(area2);
  }
  return std::min(
    { DistanceToSegment(x, a, b), DistanceToSegment(x, b, c), DistanceToSegment(x, c, a) });
}

// Signed solid angle of a triangle seen from the origin (van Oosterom and Strackee 1983).
double SolidAngle(const Vec3& a, const Vec3& b, const Vec3& c)
{
  const double la = a.norm();
  const double lb = b.norm();
  const double lc = c.norm();
  return 2.0 * std::atan2(a.dot(b.cross(c)),
                          la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

} // namespace

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

bool IsOutside(const TriangleMesh& mesh, const Vec3& center, double radius)
{
  double winding = 0.0;
  for (const auto& t : mesh.Triangles)
  {
    const Vec3& a = mesh.Points[t[0]];
    const Vec3& b = mesh.Points[t[1]];
    const Vec3& c = mesh.Points[t[2]];
    if (DistanceToTriangle(center, a, b, c) < radius)
    {
      return false;
    }
    winding += SolidAngle(a - center, b - center, c - center);
  }
  return std::abs(winding) < 2.0 * M_PI; // 4 pi inside, 0 outside
}

} // namespace waft
