// SPDX-License-Identifier: BSD-3-Clause
#include "Vortex/VortexModel.h"

#include "Base/CrossMatrix.h"

#include <cmath>

namespace waft
{

VortexParameters ToParameters(const Vortex& vortex)
{
  VortexParameters p;
  const Vec3 axis = vortex.P2 - vortex.P1;
  const double length = axis.norm();
  p.Center = 0.5 * (vortex.P1 + vortex.P2);
  p.Direction = axis / length;
  p.Shape[LogHalfLength] = std::log(0.5 * length);
  p.Shape[LinearStrength] = vortex.Strength;
  p.Shape[PeakTime] = vortex.CenterTime;
  p.Shape[LogDuration] = std::log(vortex.Duration);
  p.Shape[LogCore] = std::log(vortex.CoreRadius);
  return p;
}

void FromParameters(const VortexParameters& p, Vortex& vortex)
{
  const Vec3 half = std::exp(p.Shape[LogHalfLength]) * p.Direction.normalized();
  vortex.P1 = p.Center - half;
  vortex.P2 = p.Center + half;
  vortex.Strength = p.Shape[LinearStrength];
  vortex.CenterTime = p.Shape[PeakTime];
  vortex.Duration = std::exp(p.Shape[LogDuration]);
  vortex.CoreRadius = std::exp(p.Shape[LogCore]);
}

Vec3 EvaluateVortex(const double* center, const double* direction, const double* shape,
                    const Vec3& x, double time, VortexJacobian* jacobian)
{
  // f = k w G (along / q) cross, Eq. 13 with q = |r1 x r2|^2 + (core |r0|)^2; see Base/ForceFields.
  const Eigen::Map<const Vec3> c(center);
  const Eigen::Map<const Vec3> d(direction);
  const double h = std::exp(shape[LogHalfLength]);
  const double core = std::exp(shape[LogCore]);
  const double duration = std::exp(shape[LogDuration]);
  const double s = (time - shape[PeakTime]) / duration;
  const double k = static_cast<double>(std::exp(-0.5 * s * s) / (4.0 * EIGEN_PI));
  const Vec3 r1 = x - c + h * d;
  const Vec3 r2 = x - c - h * d;
  const Vec3 r0 = 2.0 * h * d;
  const Vec3 cross = r1.cross(r2);
  const double regular = core * core * r0.squaredNorm();
  const double q = cross.squaredNorm() + regular;
  const double n1 = r1.norm();
  const double n2 = r2.norm();
  const Vec3 u1 = n1 > 0.0 ? Vec3(r1 / n1) : Vec3(Vec3::Zero());
  const Vec3 u2 = n2 > 0.0 ? Vec3(r2 / n2) : Vec3(Vec3::Zero());
  const double along = r0.dot(u1 - u2);
  const double factor = along / q;
  const Vec3 unit = k * factor * cross; // for strength 1
  const double w = shape[LinearStrength];
  if (!jacobian)
  {
    return w * unit;
  }
  // A pole that moves by e changes r by -e and r0 by -e (first) or e (second).
  const Mat3 cross1 = CrossMatrix(r2);
  const Mat3 cross2 = -CrossMatrix(r1);
  const Vec3 turn1 = n1 > 0.0 ? Vec3((r0 - r0.dot(u1) * u1) / n1) : Vec3(Vec3::Zero());
  const Vec3 turn2 = n2 > 0.0 ? Vec3((r0 - r0.dot(u2) * u2) / n2) : Vec3(Vec3::Zero());
  const Vec3 along1 = u2 - u1 - turn1;
  const Vec3 along2 = u1 - u2 + turn2;
  const Vec3 q1 = 2.0 * (cross1.transpose() * cross) - 2.0 * core * core * r0;
  const Vec3 q2 = 2.0 * (cross2.transpose() * cross) + 2.0 * core * core * r0;
  const double kw = k * w;
  const Mat3 pole1 = kw * (factor * cross1 + cross * ((along1 - factor * q1) / q).transpose());
  const Mat3 pole2 = kw * (factor * cross2 + cross * ((along2 - factor * q2) / q).transpose());
  jacobian->Center = pole1 + pole2;
  jacobian->Direction = h * (pole2 - pole1);
  jacobian->Shape.col(LogHalfLength) = h * ((pole2 - pole1) * d);
  jacobian->Shape.col(LinearStrength) = unit;
  jacobian->Shape.col(PeakTime) = (w * s / duration) * unit;
  jacobian->Shape.col(LogDuration) = (w * s * s) * unit;
  jacobian->Shape.col(LogCore) = (-2.0 * w * regular / q) * unit;
  return w * unit;
}

} // namespace waft
