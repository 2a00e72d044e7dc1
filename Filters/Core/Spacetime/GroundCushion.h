// SPDX-License-Identifier: BSD-3-Clause
// What brakes a light thing just above a surface: the air that it has to press out of the way,
// a film far thinner than the gas particles are apart.
#pragma once

#include "Spacetime/SpacetimeModel.h"

#include <Eigen/Core>

namespace waft
{

/// An acceleration [dx / frame^2] with its derivatives by position and velocity.
struct CushionForce
{
  Vec3 Acceleration = Vec3::Zero();
  Eigen::Matrix3d ByPosition = Eigen::Matrix3d::Zero(); // row: component of the acceleration
  Eigen::Matrix3d ByVelocity = Eigen::Matrix3d::Zero();
};

/// The force on an object that is about to land (flags LandsOnFloor and LandsOnObstacle of the
/// frame without LiftsOff); zero for others. Along the surface's normal n, at the height h above
/// rest and with the object's radius R (its clearance) and drag rate k:
///   a = -q / (1 + s q) (v . n) n,   q = 4 k R^2 / (h^2 + (R / 4)^2)
/// with the step s to the next frame. Far above it is nothing; one radius up it is four times the
/// free drag; it stops a settling leaf softly, and takes no more than all of its speed in a step.
CushionForce LandingCushion(const SpacetimeModel& model, int frame, double step, std::size_t object,
                            const Vec3& position, const Vec3& velocity);

} // namespace waft
