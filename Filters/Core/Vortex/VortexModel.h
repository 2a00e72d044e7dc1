// SPDX-License-Identifier: BSD-3-Clause
// A spacetime vortex in the parameters in which it is fitted.
#pragma once

#include "Base/ForceFields.h"
#include "Base/Types.h"

namespace waft
{

/// Entries of VortexParameters::Shape.
enum VortexShape
{
  LogHalfLength = 0, // ln of half the distance of the poles [m]
  LinearStrength,    // m^2/s^2
  PeakTime,          // s
  LogDuration,       // ln s
  LogCore,           // ln m
  ShapeSize
};
using ShapeVector = Eigen::Matrix<double, ShapeSize, 1>;

/// The poles are Center -+ exp(Shape[LogHalfLength]) Direction.
struct VortexParameters
{
  Vec3 Center = Vec3::Zero();
  Vec3 Direction = Vec3::UnitZ(); // unit
  ShapeVector Shape = ShapeVector::Zero();
};

VortexParameters ToParameters(const Vortex& vortex);
/// Poles, strength, times and core radius; ids and counts are left as they are.
void FromParameters(const VortexParameters& parameters, Vortex& vortex);

struct VortexJacobian
{
  Mat3 Center, Direction; // 1/s^2, m/s^2
  Eigen::Matrix<double, 3, ShapeSize> Shape;
};

/// Acceleration at x and a time [m/s^2], and its derivatives when jacobian is given.
Vec3 EvaluateVortex(const double* center, const double* direction, const double* shape,
                    const Vec3& x, double time, VortexJacobian* jacobian);

} // namespace waft
