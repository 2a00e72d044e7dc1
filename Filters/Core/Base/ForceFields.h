// SPDX-License-Identifier: BSD-3-Clause
// Closed-form acceleration fields: spacetime vortices and decaying parallel winds.
#pragma once

#include "Base/Types.h"

#include <vector>

namespace waft
{

/// A spacetime vortex (paper, Appendix C, Eq. 13, with the denominator regularised):
///   f(x, t) = G(t) w (r0.r1/|r1| - r0.r2/|r2|) / (4 pi (|r1 x r2|^2 + (c |r0|)^2)) r1 x r2
/// with r0 = p2 - p1, r1 = x - p1, r2 = x - p2, c the core radius, and
///   G(t) = exp(-(t - CenterTime)^2 / (2 Duration^2)).
/// The regularised field is divergence-free. It is an acceleration [m/s^2].
struct Vortex
{
  int VortexId = -1;
  Vec3 P1 = Vec3::Zero(); // poles [m]
  Vec3 P2 = Vec3::UnitZ();
  double Strength = 1.0;   // w [m^2/s^2]
  double CenterTime = 0.0; // s
  double Duration = 3.0;   // s, standard deviation of the Gaussian
  double CoreRadius = 0.1; // m
  double Confidence = 1.0; // 0..1
  int ObjectCount = 0;     // tracks that witnessed it

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.VortexId...);
    visit(of.P1...);
    visit(of.P2...);
    visit(of.Strength...);
    visit(of.CenterTime...);
    visit(of.Duration...);
    visit(of.CoreRadius...);
    visit(of.Confidence...);
    visit(of.ObjectCount...);
  }

  /// Acceleration at x, without the factor of time [m/s^2].
  Vec3 SpatialAcceleration(const Vec3& x) const;
  double TimeFactor(double time) const;
  Vec3 Acceleration(const Vec3& x, double time) const;
  /// The same and its Jacobian d f_i / d x_j [1/s^2].
  Vec3 Acceleration(const Vec3& x, double time, Mat3& jacobian) const;
};

/// strength direction exp(-|x - center|^2 / 2 radius^2) exp(-(t - centerTime)^2 / 2 duration^2).
struct AnalyticWind
{
  Vec3 Direction = Vec3::UnitX();
  double Strength = 1.0; // m/s^2
  Vec3 Center = Vec3::Zero();
  double Radius = 1.0;     // m
  double CenterTime = 0.0; // s
  double Duration = 3.0;   // s

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Direction...);
    visit(of.Strength...);
    visit(of.Center...);
    visit(of.Radius...);
    visit(of.CenterTime...);
    visit(of.Duration...);
  }

  Vec3 Acceleration(const Vec3& x, double time) const;
};

/// A gust whose edge travels along its direction: behind the edge, over Width, the air is pushed
/// by Strength, which comes and goes within a quarter of that, at most half a metre, at either end.
struct WindFront
{
  Vec3 Direction = Vec3::UnitX(); // unit
  double Speed = 1.0;             // m/s, of the edge
  double Strength = 1.0;          // m/s^2
  double Width = 1.0;             // m
  double StartTime = 0.0;         // s, when the edge is at Origin
  Vec3 Origin = Vec3::Zero();     // m

  Vec3 Acceleration(const Vec3& x, double time) const;
  /// When the edge is at x [s].
  double PassesAt(const Vec3& x) const
  {
    return this->StartTime + (x - this->Origin).dot(this->Direction) / this->Speed;
  }
};

} // namespace waft
