// SPDX-License-Identifier: BSD-3-Clause
// Strips that fall by themselves: how they flutter and tumble is known from experiments.
#include "Rotation/Flight.h"
#include "RotationFixtures.h"

#include <gtest/gtest.h>

using namespace waft;
using namespace waft::fixtures;

namespace
{
struct Fall
{
  double TurnRate = 0.0;  // rad/s about the long axis, mean of the second half
  double Tilt = 0.0;      // rad, largest from level in the second half
  double LeastTilt = 0.0; // rad
  int Overturns = 0;      // times that the other side came up in the second half
};

/// A strip five times as long as wide falls for 20 s at the speed that its weight and drag balance.
Fall DropStrip(double width, double areaDensity, double start = 0.3)
{
  Shape strip = Sheet(5.0 * width, width, 8);
  ShellProperties properties;
  EXPECT_TRUE(ComputeShellProperties(strip, properties));
  PanelBody panels;
  EXPECT_TRUE(panels.Build(strip, properties, 32, SerialFor()));
  const AirCoefficients coefficients;
  const double density = 1.2;
  const double speed =
    std::sqrt(2.0 * areaDensity * StandardGravity / (density * coefficients.Drag));
  const FlightBody body(panels, properties, areaDensity * properties.Area, density, coefficients,
                        0.0, 0.0);
  constexpr int Frames = 600;
  FlightPath path;
  path.RelativeVelocities.assign(Frames + 1, Vec3(0.0, 0.0, -speed));
  FlightState state;
  state.Orientation = ExpMap(Vec3(start, 0.0, 0.0));
  state.SetVelocity(body, path.RelativeVelocities[0]);
  Fall fall;
  fall.LeastTilt = 10.0;
  bool up = true;
  for (int k = 0; k < Frames; ++k)
  {
    AdvanceFrame(body, path, k, Settling(), nullptr, state);
    const bool wasUp = up;
    up = (state.Orientation * Vec3::UnitZ()).z() > 0.0;
    if (k >= Frames / 2)
    {
      fall.Overturns += up != wasUp ? 1 : 0;
      fall.TurnRate += state.AngularVelocity(body).x() / (Frames - Frames / 2);
      const double level = std::abs((state.Orientation * Vec3::UnitZ()).z());
      fall.Tilt = std::max(fall.Tilt, std::acos(std::min(level, 1.0)));
      fall.LeastTilt = std::min(fall.LeastTilt, std::acos(std::min(level, 1.0)));
    }
  }
  fall.TurnRate = std::abs(fall.TurnRate);
  return fall;
}

/// Belmonte, Eisenberg, Moses 1998: the square root of the strip's mass over that of air of its
/// width squared and its length.
double DensityOf(double froude, double width)
{
  return froude * froude * 1.2 * width;
}
} // namespace

TEST(PlateFlight, FlutterGivesWayToTumblingNearAFroudeNumberOfTwoThirds)
{
  // Belmonte, Eisenberg, Moses 1998: 0.67. Within 0.15 of it strips go over from swinging without
  // ever turning over to turning on one way for good.
  const double width = 0.03;
  for (const double start : { 0.3, 1.0 })
  {
    double least = 0.0;
    for (const double froude : { 0.2, 0.3, 0.4, 0.5, 0.52 })
    {
      const Fall fall = DropStrip(width, DensityOf(froude, width), start);
      EXPECT_EQ(fall.Overturns, 0) << froude;
      EXPECT_LT(fall.TurnRate, 0.5) << froude;
      EXPECT_LT(fall.LeastTilt, 0.1) << froude;
      EXPECT_GT(fall.Tilt, least) << froude; // swings grow with the Froude number
      least = fall.Tilt;
    }
    EXPECT_GT(least, 0.9);
    for (const double froude : { 0.7, 0.82, 0.9, 1.0, 1.3, 1.6, 2.0 })
    {
      const Fall fall = DropStrip(width, DensityOf(froude, width), start);
      EXPECT_GT(fall.TurnRate, 10.0) << froude;
      EXPECT_NEAR(fall.TurnRate, fall.Overturns * std::acos(-1.0) / 10.0, 0.05 * fall.TurnRate)
        << froude; // never back
    }
  }
}

TEST(PlateFlight, TumblingHalvesWithTwiceTheWidth)
{
  EXPECT_NEAR(DropStrip(0.02, 0.1).TurnRate / DropStrip(0.04, 0.1).TurnRate, 2.0, 0.3);
  EXPECT_NEAR(DropStrip(0.03, 0.1).TurnRate / DropStrip(0.06, 0.1).TurnRate, 2.0, 0.3);
}

TEST(PlateFlight, TumblingGrowsByTheRootOfTheThickness)
{
  EXPECT_NEAR(DropStrip(0.03, 0.2).TurnRate / DropStrip(0.03, 0.1).TurnRate, std::sqrt(2.0),
              0.15 * std::sqrt(2.0));
  EXPECT_NEAR(DropStrip(0.04, 0.16).TurnRate / DropStrip(0.04, 0.08).TurnRate, std::sqrt(2.0),
              0.15 * std::sqrt(2.0));
}

TEST(PlateFlight, EnergyOfTheMovingAirIsKept)
{
  // Without drag, lift and circulation Kirchhoff's equations keep the energy.
  Shape strip = Sheet(0.1, 0.03, 8);
  ShellProperties properties;
  ASSERT_TRUE(ComputeShellProperties(strip, properties));
  PanelBody panels;
  ASSERT_TRUE(panels.Build(strip, properties, 32, SerialFor()));
  AirCoefficients coefficients;
  coefficients.Drag = 0.0;
  coefficients.RotationalLift = 0.0;
  coefficients.Autorotation = 0.0;
  coefficients.Separation = 0.0;
  const FlightBody body(panels, properties, 3e-4, 1.2, coefficients, 0.0, 0.0);
  FlightPath path;
  path.RelativeVelocities.assign(121, Vec3(0.3, 0.2, -0.5));
  FlightState state;
  state.SetAngularVelocity(body, Vec3(3.0, -2.0, 4.0));
  state.SetVelocity(body, path.RelativeVelocities[0]);
  const auto energy = [&]()
  {
    return 0.5 * (state.AngularMomentum.dot(state.AngularVelocity(body)) +
                  state.Momentum.dot(state.Velocity(body)));
  };
  const double before = energy();
  const Vec3 momentum = state.Momentum;
  for (int k = 0; k < 120; ++k)
  {
    AdvanceFrame(body, path, k, Settling(), nullptr, state);
    EXPECT_NEAR(energy(), before, 0.03 * before);
    EXPECT_LT((state.Momentum - momentum).norm(), 1e-12);
  }
}
