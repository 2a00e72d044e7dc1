// SPDX-License-Identifier: BSD-3-Clause
// A damping force that takes the speed along a surface's normal from an object that is about to
// land there: it stands for the air that the object has to press out of the way, a film far thinner
// than the gas particles are apart.
#pragma once

#include "Spacetime/Model/SpacetimeModel.h"

#include <Eigen/Core>

namespace waft
{

/// An acceleration [dx / frame^2] with its derivatives by position and velocity.
struct DampingForce
{
  Vec3 Acceleration = Vec3::Zero();
  Eigen::Matrix3d ByPosition = Eigen::Matrix3d::Zero(); // row: component of the acceleration
  Eigen::Matrix3d ByVelocity = Eigen::Matrix3d::Zero();
};

/// The force on an object that is about to land (flags LandsOnFloor and LandsOnObstacle of the
/// frame without LiftsOff); zero for others. Along the surface's normal n, at the height h above
/// rest, with its settling speed u (SettlingSlip) and the height b from which plans brake:
///   a = -q / (1 + s q) (v . n) n,   q = 0.6 (u / b) / ((r^2 + 0.02^2)^(1/4) (1 + r^4))
/// with r = h / b and the step s to the next frame. From far above down to rest that takes 1.13 u
/// of the speed, most of it over the height b and as the root of the height: as plans come down. It
/// takes no more than all of the speed in a step.
DampingForce LandingDamping(const SpacetimeModel& model, int frame, double step, std::size_t object,
                            const Vec3& position, const Vec3& velocity);

} // namespace waft
