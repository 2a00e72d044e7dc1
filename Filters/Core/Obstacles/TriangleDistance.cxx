// SPDX-License-Identifier: BSD-3-Clause
#include "Obstacles/TriangleDistance.h"

namespace waft
{

namespace
{

Vec3 ClosestOnSegment(const Vec3& p, const Vec3& a, const Vec3& b)
{
  const Vec3 ab = b - a;
  const double length2 = ab.squaredNorm();
  return length2 > 0.0 ? Vec3(a + std::clamp((p - a).dot(ab) / length2, 0.0, 1.0) * ab) : a;
}

bool SegmentCrossesTriangle(const Vec3& p0, const Vec3& p1, const Vec3& a, const Vec3& b,
                            const Vec3& c)
{
  const Vec3 direction = p1 - p0;
  const Vec3 e1 = b - a;
  const Vec3 e2 = c - a;
  const Vec3 h = direction.cross(e2);
  const double determinant = e1.dot(h);
  if (determinant == 0.0)
  {
    return false; // parallel: the nearest points lie on an end of the segment or on an edge
  }
  const Vec3 s = p0 - a;
  const double u = s.dot(h) / determinant;
  const Vec3 q = s.cross(e1);
  const double v = direction.dot(q) / determinant;
  const double t = e2.dot(q) / determinant;
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0 && t <= 1.0;
}

} // namespace

Vec3 ClosestOnTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 ap = p - a;
  const double d1 = ab.dot(ap);
  const double d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0)
  {
    return a;
  }
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp);
  const double d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3)
  {
    return b;
  }
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp);
  const double d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6)
  {
    return c;
  }
  const double vc = d1 * d4 - d3 * d2;
  const double vb = d5 * d2 - d1 * d6;
  const double va = d3 * d6 - d5 * d4;
  const double sum = va + vb + vc; // |ab x ac|^2 without rounding
  if (va > 0.0 && vb > 0.0 && vc > 0.0 && sum > 0.0)
  {
    return a + (vb / sum) * ab + (vc / sum) * ac;
  }
  const Vec3 candidates[3] = { ClosestOnSegment(p, a, b), ClosestOnSegment(p, b, c),
                               ClosestOnSegment(p, c, a) };
  int best = 0;
  for (int k = 1; k < 3; ++k)
  {
    if ((candidates[k] - p).squaredNorm() < (candidates[best] - p).squaredNorm())
    {
      best = k;
    }
  }
  return candidates[best];
}

double SquaredDistanceOfSegments(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1)
{
  const Vec3 d1 = p1 - p0;
  const Vec3 d2 = q1 - q0;
  const Vec3 r = p0 - q0;
  const double a = d1.squaredNorm();
  const double e = d2.squaredNorm();
  const double f = d2.dot(r);
  double s = 0.0;
  double t = 0.0;
  if (a > 0.0 && e > 0.0)
  {
    const double c = d1.dot(r);
    const double b = d1.dot(d2);
    const double denominator = a * e - b * b;
    s = denominator > 1e-14 * a * e ? std::clamp((b * f - c * e) / denominator, 0.0, 1.0) : 0.0;
    t = (b * s + f) / e;
    if (t < 0.0 || t > 1.0)
    {
      t = std::clamp(t, 0.0, 1.0);
      s = std::clamp((b * t - c) / a, 0.0, 1.0);
    }
  }
  else if (a > 0.0)
  {
    s = std::clamp(-d1.dot(r) / a, 0.0, 1.0);
  }
  else if (e > 0.0)
  {
    t = std::clamp(f / e, 0.0, 1.0);
  }
  return (p0 + s * d1 - q0 - t * d2).squaredNorm();
}

bool SegmentNearTriangle(const Vec3& p0, const Vec3& p1, double radius, const Vec3& a,
                         const Vec3& b, const Vec3& c)
{
  // Both ends on one side of the plane and farther than the radius: nothing can touch.
  const Vec3 normal = (b - a).cross(c - a);
  const double reach = radius * normal.norm() * (1.0 + 1e-12);
  const double h0 = normal.dot(p0 - a);
  const double h1 = normal.dot(p1 - a);
  if (reach > 0.0 && ((h0 > reach && h1 > reach) || (h0 < -reach && h1 < -reach)))
  {
    return false;
  }
  const double r2 = radius * radius;
  return SegmentCrossesTriangle(p0, p1, a, b, c) ||
         (ClosestOnTriangle(p0, a, b, c) - p0).squaredNorm() < r2 ||
         (ClosestOnTriangle(p1, a, b, c) - p1).squaredNorm() < r2 ||
         SquaredDistanceOfSegments(p0, p1, a, b) < r2 ||
         SquaredDistanceOfSegments(p0, p1, b, c) < r2 ||
         SquaredDistanceOfSegments(p0, p1, c, a) < r2;
}

} // namespace waft
