// SPDX-License-Identifier: BSD-3-Clause
// What acts on single bodies, in double precision, with its derivatives: plain code to hold the
// fast kernels against.
#pragma once

#include "Spacetime/Model/SpacetimeModel.h"

namespace waft
{
namespace test
{

struct OutsideForce
{
  Vec3 Acceleration = Vec3::Zero(); // dx / frame^2
  Mat3 ByPosition = Mat3::Zero();   // row: component of the acceleration
  Mat3 ByVelocity = Mat3::Zero();
};

/// Vortices, gravity, springs of walls and obstacles, winds and the damping of landings on a body
/// at a frame, with the step to the next one.
OutsideForce ForceOn(const SpacetimeModel& model, int frame, double step, std::size_t body,
                     const Vec3& position, const Vec3& velocity);

} // namespace test
} // namespace waft
