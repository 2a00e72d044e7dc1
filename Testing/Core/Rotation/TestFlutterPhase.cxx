// SPDX-License-Identifier: BSD-3-Clause
// When a fluttering strip glides: by equations that were fitted to measurements, and by the plate's
// law. Prints rows of a table of Documentation/RotationRefineFilter.md (make_nature_table.py).
#include "Rotation/Flight.h"
#include "RotationFixtures.h"

#include <gtest/gtest.h>

#include <cstdio>

using namespace waft;
using namespace waft::fixtures;

namespace
{
const double Pi = std::acos(-1.0);
constexpr double Density = 1.2; // kg/m^3, of the air

/// Of a plate that swings: how its glide along the way that it leans to goes with sin(2 tilt).
class GlideByTilt
{
public:
  void Add(const Vec3& normal, const Vec3& velocity)
  {
    const Vec3 up = normal.z() < 0.0 ? Vec3(-normal) : normal;
    const Vec3 downhill(up.x(), up.y(), 0.0);
    if (downhill.norm() > 1e-9)
    {
      const double glide = velocity.dot(downhill.normalized());
      const double tilted = 2.0 * up.z() * downhill.norm();
      this->Sums += Vec3(1.0, glide, tilted);
      this->Squares += Vec3(glide * glide, tilted * tilted, glide * tilted);
    }
  }
  double Correlation() const
  {
    const double n = this->Sums[0];
    const Vec3 mean = this->Sums / n;
    const Vec3 squares = this->Squares / n;
    return (squares[2] - mean[1] * mean[2]) /
           std::sqrt((squares[0] - mean[1] * mean[1]) * (squares[1] - mean[2] * mean[2]));
  }

private:
  Vec3 Sums = Vec3::Zero(), Squares = Vec3::Zero();
};

/// Andersen, Pesavento, Wang 2005 (J. Fluid Mech. 541, 65): an elliptic strip, eight times as wide
/// as thick, falls in two dimensions; equations 6.1 to 6.3 with their coefficients for thin ones.
/// In units of half its width and of its speed.
double MeasuredStrip(double inertia)
{
  using State = Eigen::Matrix<double, 4, 1>; // along, across, angle, rate
  constexpr double Thin = 1.0 / 8.0;
  const auto change = [&](const State& s)
  {
    const double u = s[0], v = s[1], w = s[3];
    const double q = std::hypot(u, v) + 1e-12;
    const double circulation = 2.0 / Pi * (-1.2 * u * v / q + Pi * w);
    const double drag = (1.4 - (u * u - v * v) / (q * q)) * q / Pi;
    const double b = Thin * Thin;
    State d;
    d[0] = ((inertia + 1.0) * w * v - circulation * v - std::sin(s[2]) - drag * u) / (inertia + b);
    d[1] = (-(inertia + b) * w * u + circulation * u - std::cos(s[2]) - drag * v) / (inertia + 1.0);
    d[2] = w;
    d[3] = ((b - 1.0) * u * v - (0.2 + 0.2 * std::abs(w)) * w) /
           (0.25 * (inertia * (1.0 + b) + 0.5 * (1.0 - b) * (1.0 - b)));
    return d;
  };
  constexpr double Step = 0.005;
  GlideByTilt glides;
  State s(0.01, -0.01, 0.3, 0.0);
  for (int i = 0; i < 24000; ++i)
  {
    const State one = change(s), two = change(s + 0.5 * Step * one);
    const State three = change(s + 0.5 * Step * two), four = change(s + Step * three);
    s += Step / 6.0 * (one + 2.0 * two + 2.0 * three + four);
    if (i >= 8000)
    {
      const double c = std::cos(s[2]), d = std::sin(s[2]);
      glides.Add(Vec3(-d, 0.0, c), Vec3(s[0] * c - s[1] * d, 0.0, s[0] * d + s[1] * c));
    }
  }
  return glides.Correlation();
}

/// The same of a strip five times as long as wide by the plate's law.
double FlownStrip(double froude)
{
  constexpr double Width = 0.03;
  const double areaDensity = froude * froude * Density * Width;
  const Shape strip = Sheet(5.0 * Width, Width, 8);
  ShellProperties properties;
  EXPECT_TRUE(ComputeShellProperties(strip, properties));
  PanelBody panels;
  EXPECT_TRUE(panels.Build(strip, properties, 32, SerialFor()));
  const AirCoefficients coefficients;
  const FlightBody body(panels, properties, areaDensity * properties.Area, Density, coefficients,
                        0.0, 0.0);
  const double speed =
    std::sqrt(2.0 * areaDensity * StandardGravity / (Density * coefficients.Drag));
  FlightPath path;
  path.Step = 0.01;
  path.RelativeVelocities.assign(2, -speed * Vec3::UnitZ());
  FlightState state;
  state.Orientation = ExpMap(Vec3(0.3, 0.0, 0.0));
  state.SetVelocity(body, path.RelativeVelocities[0]);
  GlideByTilt glides;
  for (int k = 0; k < 1500; ++k)
  {
    AdvanceFrame(body, path, 0, Settling(), nullptr, state);
    if (k >= 500)
    {
      glides.Add(state.Orientation * Vec3::UnitZ(), state.Velocity(body));
    }
  }
  return glides.Correlation();
}
} // namespace

TEST(Nature, AFlutteringPlateIsFastestWhereItIsFlat)
{
  // Its glide comes a quarter of a period after its tilt: the two have little to do with one
  // another at any one time. In the plate's law that is so where it swings wide.
  std::printf("| flutter | glide by sin(2 tilt) |\n|---|---|\n");
  for (const double inertia : { 0.2, 0.5, 0.8 })
  {
    const double measured = MeasuredStrip(inertia);
    std::printf("| Andersen, Pesavento, Wang 2005, I* %.1f | %.2f |\n", inertia, measured);
    EXPECT_LT(std::abs(measured), 0.2);
  }
  double before = 0.7;
  for (const double froude : { 0.3, 0.4, 0.5 })
  {
    const double flown = FlownStrip(froude);
    std::printf("| strip of Froude number %.1f | %.2f |\n", froude, flown);
    EXPECT_LT(flown, before);
    before = flown;
  }
  EXPECT_LT(std::abs(before), 0.3);
  std::printf("\n");
}
