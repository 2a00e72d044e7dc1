// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceForces.h"

#include "Spacetime/Energy/LandingDamping.h"

#include <algorithm>

namespace waft
{
namespace test
{
namespace
{

constexpr double Stiffness = 0.3;        // of the springs [1 / (dx frame^2)]
constexpr double LeastTimeFactor = 1e-3; // a weaker vortex is left out

/// The three quadratic B-splines that are not zero about a place along one axis.
struct SplineAxis
{
  int First = 0;
  double Value[3], Slope[3]; // slopes by the place

  SplineAxis(double place, double origin, double spacing, int nodes)
  {
    const double x = (place - origin) / spacing;
    const double c = std::clamp(x, 0.5, nodes - 1.5);
    const int centre = std::min(static_cast<int>(c + 0.5), nodes - 2);
    const double t = c - centre;
    this->First = centre - 1;
    const double values[3] = { 0.5 * (0.5 - t) * (0.5 - t), 0.75 - t * t,
                               0.5 * (0.5 + t) * (0.5 + t) };
    const double slopes[3] = { t - 0.5, -2.0 * t, t + 0.5 };
    for (int k = 0; k < 3; ++k)
    {
      this->Value[k] = values[k];
      this->Slope[k] = c == x ? slopes[k] / spacing : 0.0;
    }
  }
};

void AddSpline(const SplineWind& wind, int frame, double factor, const Vec3& x, OutsideForce& force)
{
  std::vector<float> coefficients;
  wind.At(frame, coefficients);
  const SplineAxis axes[3] = {
    SplineAxis(x[0], wind.Origin[0], wind.Spacing[0], wind.Dimensions[0]),
    SplineAxis(x[1], wind.Origin[1], wind.Spacing[1], wind.Dimensions[1]),
    SplineAxis(x[2], wind.Origin[2], wind.Spacing[2], wind.Dimensions[2])
  };
  for (int node = 0; node < 27; ++node)
  {
    const int at[3] = { node % 3, node / 3 % 3, node / 9 };
    std::size_t place = 0;
    for (int a = 2; a >= 0; --a)
    {
      place = place * static_cast<std::size_t>(wind.Dimensions[a]) + axes[a].First + at[a];
    }
    double value = factor;
    Vec3 slope = Vec3::Constant(factor);
    for (int a = 0; a < 3; ++a)
    {
      value *= axes[a].Value[at[a]];
      for (int c = 0; c < 3; ++c)
      {
        slope[c] *= c == a ? axes[a].Slope[at[a]] : axes[a].Value[at[a]];
      }
    }
    for (int c = 0; c < 3; ++c)
    {
      const double coefficient = coefficients[4 * place + c];
      force.Acceleration[c] += value * coefficient;
      force.ByPosition.row(c) += coefficient * slope.transpose();
    }
  }
}

/// Pushes with the square of how much nearer than SpringReach the surface is.
void AddSpring(double distance, const Vec3& normal, const Mat3& curvature, OutsideForce& force)
{
  const double depth = std::max(0.0, SpringReach - distance);
  force.Acceleration += Stiffness * depth * depth * normal;
  force.ByPosition +=
    Stiffness * (depth * depth * curvature - 2.0 * depth * normal * normal.transpose());
}

} // namespace

OutsideForce ForceOn(const SpacetimeModel& model, int frame, double step, std::size_t body,
                     const Vec3& position, const Vec3& velocity)
{
  OutsideForce force;
  for (const Vortex& vortex : model.Fields.Vortices)
  {
    if (vortex.TimeFactor(frame) >= LeastTimeFactor)
    {
      Mat3 slope;
      force.Acceleration += vortex.Acceleration(position, frame, slope);
      force.ByPosition += slope;
    }
  }
  if (!model.Fields.Wind.IsEmpty())
  {
    AddSpline(model.Fields.Wind, frame, 1.0, position, force);
  }
  if (!model.Background.IsEmpty())
  {
    const double drag = model.Background.Drag;
    AddSpline(model.Background, frame, drag > 0.0 ? drag : 1.0, position, force);
    force.Acceleration -= drag * velocity;
    force.ByVelocity -= drag * Mat3::Identity();
  }
  if (body < model.NumberOfGas)
  {
    for (int c = 0; c < 3; ++c)
    {
      AddSpring(position[c], Vec3::Unit(c), Mat3::Zero(), force);
      AddSpring(model.Size[c] - position[c], -Vec3::Unit(c), Mat3::Zero(), force);
    }
    if (!model.Obstacles.IsEmpty())
    {
      Vec3 normal;
      Mat3 curvature;
      const double distance = model.Obstacles.Evaluate(position, frame, normal, curvature);
      AddSpring(distance, normal, curvature, force);
    }
    return force;
  }
  const std::size_t object = body - model.NumberOfGas;
  force.Acceleration.z() -= model.Gravities[object];
  const DampingForce damping = LandingDamping(model, frame, step, object, position, velocity);
  force.Acceleration += damping.Acceleration;
  force.ByPosition += damping.ByPosition;
  force.ByVelocity += damping.ByVelocity;
  return force;
}

} // namespace test
} // namespace waft
