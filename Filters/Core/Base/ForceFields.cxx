// SPDX-License-Identifier: BSD-3-Clause
#include "Base/ForceFields.h"

#include "Base/SmoothStep.h"

#include "Base/CrossMatrix.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{
constexpr double WidestEdge = 2.0; // m, of a front whose edges are as wide as they may be

// r / |r|, zero at the pole itself, where the cross product vanishes anyway.
Vec3 Unit(const Vec3& r, double length)
{
  return length > 0.0 ? Vec3(r / length) : Vec3(Vec3::Zero());
}

} // namespace

double Vortex::TimeFactor(double time) const
{
  const double s = (time - this->CenterTime) / this->Duration;
  return std::exp(-0.5 * s * s);
}

Vec3 Vortex::SpatialAcceleration(const Vec3& x) const
{
  const Vec3 r0 = this->P2 - this->P1;
  const Vec3 r1 = x - this->P1;
  const Vec3 r2 = x - this->P2;
  const Vec3 cross = r1.cross(r2);
  const double denominator =
    4.0 * M_PI * (cross.squaredNorm() + this->CoreRadius * this->CoreRadius * r0.squaredNorm());
  if (denominator <= 0.0)
  {
    return Vec3::Zero();
  }
  const double along = r0.dot(Unit(r1, r1.norm())) - r0.dot(Unit(r2, r2.norm()));
  return (this->Strength * along / denominator) * cross;
}

Vec3 Vortex::Acceleration(const Vec3& x, double time) const
{
  return this->TimeFactor(time) * this->SpatialAcceleration(x);
}

Vec3 Vortex::Acceleration(const Vec3& x, double time, Mat3& jacobian) const
{
  const Vec3 r0 = this->P2 - this->P1;
  const Vec3 r1 = x - this->P1;
  const Vec3 r2 = x - this->P2;
  const Vec3 cross = r1.cross(r2);
  const double core = this->CoreRadius * this->CoreRadius * r0.squaredNorm();
  const double q = cross.squaredNorm() + core;
  jacobian.setZero();
  if (q <= 0.0)
  {
    return Vec3::Zero();
  }
  const double n1 = r1.norm();
  const double n2 = r2.norm();
  const Vec3 u1 = Unit(r1, n1);
  const Vec3 u2 = Unit(r2, n2);
  const double along = r0.dot(u1) - r0.dot(u2);
  const double scale = this->TimeFactor(time) * this->Strength / (4.0 * M_PI);

  // r1 x r2 = (x - p1) x (x - p2), so d(cross) dx = dx x r2 + r1 x dx = (r1 - r2) x dx = r0 x dx.
  const Mat3 dCross = CrossMatrix(r0);
  Vec3 dAlong = Vec3::Zero();
  if (n1 > 0.0)
  {
    dAlong += (r0 - r0.dot(u1) * u1) / n1;
  }
  if (n2 > 0.0)
  {
    dAlong -= (r0 - r0.dot(u2) * u2) / n2;
  }
  const Vec3 dQ = 2.0 * (dCross.transpose() * cross);
  const Vec3 dFactor = dAlong / q - (along / (q * q)) * dQ;
  jacobian = scale * (cross * dFactor.transpose() + (along / q) * dCross);
  return (scale * along / q) * cross;
}

Vec3 AnalyticWind::Acceleration(const Vec3& x, double time) const
{
  const double s = (time - this->CenterTime) / this->Duration;
  const double d2 = (x - this->Center).squaredNorm() / (this->Radius * this->Radius);
  return (this->Strength * std::exp(-0.5 * (s * s + d2))) * this->Direction;
}

Vec3 WindFront::Acceleration(const Vec3& x, double time) const
{
  const double edge = 0.25 * std::min(this->Width, WidestEdge); // m
  const double behind = (time - this->PassesAt(x)) * this->Speed;
  const double part = SmoothStep(behind / edge) * SmoothStep((this->Width - behind) / edge);
  return part * this->Strength * this->Direction;
}

} // namespace waft
