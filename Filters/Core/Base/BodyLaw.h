// SPDX-License-Identifier: BSD-3-Clause
// How a thin body goes through the air, said once for all stages. A shape with a way of its own is
// told here, in LawOf and TurningLaw.
#pragma once

#include "Base/Motion.h"
#include "Base/Shape.h"

#include <algorithm>

namespace waft
{

/// The law of a body's path: drag in proportion to the speed through the air, as Maxey and Riley
/// 1983 (Phys. Fluids 26, 883) have it, without the terms of the air's own mass,
///   v' = (u - f s - v) / T,   T = s_z / g,
/// with the air's velocity u, the slip s and the factor f that a surface leaves of it
/// (Constraints/GroundEffect.h; 1 in flight). With s = SettlingSpeed e_z and f = 1 this is
/// v' = (u - v) g / SettlingSpeed - g e_z. Without inertia, T = 0, it is v = u - f s.
/// In metres and seconds, unless In has changed them.
struct BodyLaw
{
  /// s [m/s]: the air's velocity relative to a body in steady flight; its z is 0 or more. Zero: the
  /// body goes with the air.
  Vec3 Slip = Vec3::Zero();

  /// Straight down through still air, at a speed of 0 or more [m/s].
  static BodyLaw Sinking(double speed)
  {
    BodyLaw law;
    law.Slip.z() = speed;
    return law;
  }

  /// Terminal speed downwards in still air, s_z [m/s].
  double SettlingSpeed() const { return this->Slip.z(); }

  /// v = u - f s: the velocity without inertia [m/s], in air of the velocity `air`.
  Vec3 Velocity(const Vec3& air, double factor = 1.0) const { return air - factor * this->Slip; }

  /// By the place: the gradient of Velocity [1/s], of the air's and of the factor [1/m].
  Mat3 VelocityGradient(const Mat3& air, const Vec3& factor) const
  {
    return air - this->Slip * factor.transpose();
  }

  /// T [s], in which the body comes after the air, where a gravity above 0 [m/s^2] makes it settle.
  double ResponseTime(double gravity) const { return this->SettlingSpeed() / gravity; }

  /// 1 / T [1/s], as that of 1 mm/s for what settles more slowly. A gravity given as the speed
  /// gained in some other time, a frame, makes it per that time.
  double ResponseRate(double gravity) const
  {
    return gravity / std::max(1e-3, this->SettlingSpeed());
  }

  /// The same in units of a length and a time above 0 [m, s].
  BodyLaw In(double length, double time) const
  {
    BodyLaw law = *this;
    law.Slip = this->Slip * time / length;
    return law;
  }
};

/// Every body of today sinks straight down.
inline BodyLaw LawOf(const MotionObject& body)
{
  return BodyLaw::Sinking(body.SettlingSpeed);
}

/// What of the air's torque is a body's own (Rotation/PanelBody.h has the forces).
struct TurningLaw
{
  double Drag = 1.2;    // cd of Shi et al. 2005, Eq. 5, broadside
  double Damping = 0.0; // 1/s, by the stickiness of the air (Happel and Brenner 1965, section 5-1)
};

inline TurningLaw TurningLawOf(const Shape& shape)
{
  return { shape.DragCoefficient, shape.Damping };
}

} // namespace waft
