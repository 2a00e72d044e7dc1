// SPDX-License-Identifier: BSD-3-Clause
// How hard a thin body's weight draws it, so that it comes down as fast as its shape says.
#pragma once

#include "Base/Parallel.h"
#include "Base/Pose.h"
#include "Rotation/Flight.h"

#include <functional>

namespace waft
{

/// What turns a body and what it weighs.
struct Glider
{
  const PanelBody& Panels;
  const ShellProperties& Properties;
  double Mass;       // kg, that turns
  double AirDensity; // kg/m^3
  AirCoefficients Coefficients;
  double Damping, Follow; // 1/s, as FlightBody has them, of its own turning's seconds
  double Pace = 1.0;      // those in a second (Pace.h)
  TurningEase Ease = {};

  /// The body where its weight is its drag broadside at a speed [m/s]: the mass that slips is that
  /// of this weight.
  FlightBody DrawnAt(double speed) const;
  /// kg, that slips then: that of this weight, or that turns at a speed of 0.
  double SlippingMass(double speed) const;
  BodyFactors FactorsAt(double speed) const;
};

/// The speed of the weight over the mean speed at which the body then falls through still air,
/// fluttering and tumbling as it does: 1 where it falls broadside, and for bodies that do not slip.
/// Over falls of some seconds from poses all around, the i-th of a body like glider(i).
/// settlingSpeed [m/s]: the mean that is wanted.
double DrawOverFall(const std::function<Glider(std::size_t)>& glider, double settlingSpeed,
                    const ParallelFor& parallel);

} // namespace waft
