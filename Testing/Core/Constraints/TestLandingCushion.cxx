// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/LandingCushion.h"

#include "Obstacles/Shapes.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace waft;
using namespace waft::testing;

namespace
{

constexpr double Settling = 0.5;    // m/s
constexpr double RestHeight = 0.01; // m
constexpr double Height = 2.0 / M_PI * 0.15 * Settling;

/// A slope of 30 degrees, landed on at frame 60.
struct OnASlope
{
  OnASlope()
  {
    ObstacleMesh slope;
    slope.ObstacleId = 3;
    slope.Mesh = MakeBox({ Vec3(-2, -2, -1), Vec3(2, 2, 0) });
    for (Vec3& p : slope.Mesh.Points)
    {
      p.z() += p.x() * std::tan(M_PI / 6.0);
    }
    EXPECT_TRUE(this->Obstacles.Build({ slope }));
    LandingWindow landing;
    landing.ObstacleId = 3;
    landing.Frame = 60;
    landing.First = 30.0;
    this->Cushion = LandingCushion(this->Obstacles, { landing }, RestHeight, Settling);
  }
  static Vec3 Above(double height)
  {
    return Vec3(0.2, 0.1, 0.2 * std::tan(M_PI / 6.0)) + height * Normal();
  }
  static Vec3 Normal() { return { -0.5, 0.0, std::cos(M_PI / 6.0) }; }

  ObstacleSet Obstacles;
  LandingCushion Cushion;
};

} // namespace

TEST(LandingCushion, WhatComesDownIsSlowedFromItsHeightOn)
{
  const OnASlope scene;
  EXPECT_EQ(LandingCushion().Factor(OnASlope::Above(0.02), 55.0), 1.0);
  EXPECT_EQ(scene.Cushion.Factor(OnASlope::Above(RestHeight + 1.001 * Height), 55.0), 1.0);
  double last = 1.0;
  for (double part = 0.99; part > 0.0; part -= 0.05)
  {
    const double factor = scene.Cushion.Factor(OnASlope::Above(RestHeight + part * Height), 55.0);
    EXPECT_LT(factor, last) << part;
    EXPECT_NEAR(factor, std::sqrt(2.0 * part - part * part), 0.25 - 0.25 * part + 1e-3) << part;
    last = factor;
  }
  EXPECT_LT(scene.Cushion.Factor(OnASlope::Above(RestHeight), 60.0), 0.21);
}

TEST(LandingCushion, OnlyShortlyBeforeItsTouchDown)
{
  const OnASlope scene;
  const Vec3 x = OnASlope::Above(RestHeight + 0.2 * Height);
  EXPECT_EQ(scene.Cushion.Factor(x, 53.5), 1.0);
  EXPECT_LT(scene.Cushion.Factor(x, 54.5), 1.0);
  EXPECT_LT(scene.Cushion.Factor(x, 60.0), 1.0);
  EXPECT_EQ(scene.Cushion.Factor(x, 60.5), 1.0); // lying there, and lifted off
}

TEST(LandingCushion, ItsGradientIsThatOfCentralDifferences)
{
  const OnASlope scene;
  for (const double part : { 0.1, 0.4, 0.9 })
  {
    const Vec3 x = OnASlope::Above(RestHeight + part * Height);
    Vec3 gradient;
    (void)scene.Cushion.Factor(x, 55.5, &gradient);
    for (int c = 0; c < 3; ++c)
    {
      constexpr double h = 1e-6;
      const double rise = scene.Cushion.Factor(x + h * Vec3::Unit(c), 55.5) -
                          scene.Cushion.Factor(x - h * Vec3::Unit(c), 55.5);
      EXPECT_NEAR(gradient[c], rise / (2.0 * h), 1e-4) << part;
    }
  }
}

TEST(LandingCushion, WhatSettlesStraightOntoItIsThereInTheCushionsTime)
{
  const OnASlope scene;
  double height = Height;
  double time = 0.0;
  for (constexpr double step = 1e-5; height > 0.0 && time < 1.0; time += step)
  {
    height -= step * Settling * scene.Cushion.Factor(OnASlope::Above(RestHeight + height), 55.0);
  }
  EXPECT_NEAR(time, 0.15, 0.03);
}
