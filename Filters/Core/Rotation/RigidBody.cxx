// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/RigidBody.h"

#include <cmath>

namespace waft
{

Result ComputeShellProperties(const Shape& shape, ShellProperties& properties)
{
  const TriangleMesh& mesh = shape.Mesh;
  const std::string name = "shape '" + shape.Name + "'";
  ShellProperties result;
  for (const Vec3& point : mesh.Points)
  {
    if (!point.allFinite())
    {
      return Result::Error(name + ": a point is not finite");
    }
    result.BoundingRadius = std::max(result.BoundingRadius, point.norm());
  }
  Mat3 second = Mat3::Zero();
  Mat3 normals = Mat3::Zero();
  for (const auto& triangle : mesh.Triangles)
  {
    for (const int index : triangle)
    {
      if (index < 0 || index >= static_cast<int>(mesh.Points.size()))
      {
        return Result::Error(name + ": a triangle names point " + std::to_string(index) + " of " +
                             std::to_string(mesh.Points.size()));
      }
    }
    const Vec3& a = mesh.Points[triangle[0]];
    const Vec3& b = mesh.Points[triangle[1]];
    const Vec3& c = mesh.Points[triangle[2]];
    const Vec3 cross = (b - a).cross(c - a);
    const double length = cross.norm();
    if (length <= 0.0)
    {
      continue;
    }
    const double area = 0.5 * length;
    const Vec3 sum = a + b + c;
    result.Area += area;
    result.Center += area / 3.0 * sum;
    // The integral of r r^T over a triangle.
    second += area / 12.0 *
              (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
    normals += area / (length * length) * cross * cross.transpose();
  }
  if (!(result.Area > 0.0))
  {
    return Result::Error(name + ": expected a mesh with area, found none");
  }
  if (!(shape.Thickness >= 0.0) || !std::isfinite(shape.Thickness))
  {
    return Result::Error(name + ": Thickness must be at least 0");
  }
  result.Center /= result.Area;
  result.NormalTensor = normals / result.Area;
  result.SecondMoment = second / result.Area - result.Center * result.Center.transpose();
  const Mat3 body =
    result.SecondMoment + shape.Thickness * shape.Thickness / 12.0 * result.NormalTensor;
  result.InertiaPerMass = body.trace() * Mat3::Identity() - body;
  properties = result;
  return Result::Ok();
}

Quat ExpMap(const Vec3& v)
{
  const double angle = v.norm();
  // sin(x/2)/x, by its series where the quotient loses digits
  const double factor = angle > 1e-4 ? std::sin(0.5 * angle) / angle : 0.5 - angle * angle / 48.0;
  Quat q(std::cos(0.5 * angle), factor * v.x(), factor * v.y(), factor * v.z());
  q.normalize();
  return q;
}

Vec3 SignedLogMap(const Quat& q)
{
  const double sine = q.vec().norm();
  if (sine < 1e-12)
  {
    return 2.0 * q.vec();
  }
  return 2.0 * std::atan2(sine, q.w()) / sine * q.vec();
}

Vec3 LogMap(const Quat& q)
{
  return q.w() >= 0.0 ? SignedLogMap(q) : SignedLogMap(Quat(-q.coeffs()));
}

Quat LeastTurn(const Vec3& a, const Vec3& b, const Vec3& fallback)
{
  const Vec3 axis = a.cross(b);
  const double sine = axis.norm();
  const double cosine = a.dot(b);
  if (sine < 1e-9)
  {
    if (cosine > 0.0)
    {
      return Quat::Identity();
    }
    Vec3 across = fallback - fallback.dot(a) * a;
    if (across.norm() < 1e-6)
    {
      across = a.unitOrthogonal();
    }
    return ExpMap(std::acos(-1.0) * across.normalized());
  }
  return ExpMap(std::atan2(sine, cosine) / sine * axis);
}

Mat3 CrossMatrix(const Vec3& v)
{
  Mat3 m;
  m << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return m;
}

} // namespace waft
