// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/GroundEffect.h"

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
constexpr double Length = 0.2; // m
constexpr double Rate = 30.0;  // 1/s
constexpr double Wind = 0.8;   // m/s

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
    landing.Until = 70;
    landing.Centre.Place = Above(RestHeight);
    landing.Normal = Normal();
    MotionObject body;
    body.RestHeight = RestHeight;
    body.ClearanceRadius = 0.5 * Length;
    body.SettlingSpeed = Settling;
    this->Ground = GroundEffect(this->Obstacles, { landing }, body, Rate, nullptr);
    this->Windy = GroundEffect(this->Obstacles, { landing }, body, Rate,
                               [](const Vec3& x, int)
                               {
                                 EXPECT_LT((x - Above(RestHeight + Length)).norm(), 1e-12);
                                 return Vec3(0.0, Wind, 0.0);
                               });
  }
  static Vec3 Above(double height)
  {
    return Vec3(0.2, 0.1, 0.2 * std::tan(M_PI / 6.0)) + height * Normal();
  }
  static Vec3 Normal() { return { -0.5, 0.0, std::cos(M_PI / 6.0) }; }

  ObstacleSet Obstacles;
  GroundEffect Ground;
  GroundEffect Windy;
};

} // namespace

TEST(GroundEffect, WhatComesDownIsSlowedFromItsHeightOn)
{
  const OnASlope scene;
  EXPECT_EQ(GroundEffect().Factor(OnASlope::Above(0.02), 55.0), 1.0);
  EXPECT_EQ(scene.Ground.Factor(OnASlope::Above(RestHeight + 1.001 * Height), 55.0), 1.0);
  double last = 1.0;
  for (double part = 0.99; part > 0.0; part -= 0.05)
  {
    const double factor = scene.Ground.Factor(OnASlope::Above(RestHeight + part * Height), 55.0);
    EXPECT_LT(factor, last) << part;
    EXPECT_NEAR(factor, std::sqrt(2.0 * part - part * part), 0.25 - 0.25 * part + 1e-3) << part;
    last = factor;
  }
  EXPECT_LT(scene.Ground.Factor(OnASlope::Above(RestHeight), 60.0), 0.21);
}

TEST(GroundEffect, OnlyShortlyBeforeItsTouchDown)
{
  const OnASlope scene;
  const Vec3 x = OnASlope::Above(RestHeight + 0.2 * Height);
  EXPECT_EQ(scene.Ground.Factor(x, 50.5), 1.0);
  const double whole = scene.Ground.Factor(x, 54.5);
  EXPECT_LT(whole, 1.0);
  EXPECT_NEAR(scene.Ground.Factor(x, 52.5), 0.5 * (1.0 + whole), 1e-12); // it comes by and by
  EXPECT_EQ(scene.Ground.Factor(x, 55.0), whole);
  EXPECT_LT(scene.Ground.Factor(x, 60.0), 1.0);
  EXPECT_EQ(scene.Ground.Factor(x, 60.5), 1.0); // lying there
}

TEST(GroundEffect, ItsGradientIsThatOfCentralDifferences)
{
  const OnASlope scene;
  for (const double frame : { 55.5, 73.25 }) // landing, and lifted
  {
    for (const double part : { 0.1, 0.4, 0.9 })
    {
      const Vec3 x = OnASlope::Above(RestHeight + part * (frame < 60.0 ? Height : Length));
      Vec3 gradient;
      (void)scene.Windy.Factor(x, frame, &gradient);
      EXPECT_GT(gradient.norm(), 0.1);
      for (int c = 0; c < 3; ++c)
      {
        constexpr double h = 1e-6;
        const double rise = scene.Windy.Factor(x + h * Vec3::Unit(c), frame) -
                            scene.Windy.Factor(x - h * Vec3::Unit(c), frame);
        EXPECT_NEAR(gradient[c], rise / (2.0 * h), 1e-6) << frame << ", " << part;
      }
    }
  }
}

TEST(GroundEffect, WindLiftsWhatLies)
{
  const OnASlope scene;
  const double lift = 0.8 * Wind * Wind / Settling / Settling;
  ASSERT_GT(lift, 1.5);
  const auto factor = [](const GroundEffect& ground, double height, double frame)
  { return ground.Factor(OnASlope::Above(RestHeight + height), frame); };
  EXPECT_EQ(factor(scene.Windy, 0.0, 69.0), 1.0);
  EXPECT_NEAR(factor(scene.Windy, 0.0, 70.0), 0.0, 1e-9); // the surface bears it still
  EXPECT_LT(factor(scene.Windy, 0.0, 73.0), 1.0 - 0.9 * lift);
  EXPECT_NEAR(1.0 - factor(scene.Windy, 0.5 * Length, 73.0),
              0.5 * (1.0 - factor(scene.Windy, 0.0, 73.0)), 1e-9);
  EXPECT_EQ(factor(scene.Windy, 1.001 * Length, 73.0), 1.0);
  EXPECT_EQ(factor(scene.Ground, 0.0, 73.0), 1.0); // no wind
}

TEST(GroundEffect, TheLiftIsLostAsItTurns)
{
  const OnASlope scene;
  double before = 1.0 - scene.Windy.Factor(OnASlope::Above(0.05), 73.0);
  for (double frame = 73.5; frame < 88.0; frame += 0.5)
  {
    const double lift = 1.0 - scene.Windy.Factor(OnASlope::Above(0.05), frame);
    EXPECT_LT(lift, before) << frame;
    before = lift;
  }
  EXPECT_NEAR(scene.Windy.Factor(OnASlope::Above(0.05), 88.0), 1.0, 1e-12);
  EXPECT_EQ(scene.Windy.Factor(OnASlope::Above(0.05), 90.0), 1.0);
}

TEST(GroundEffect, WhatSettlesStraightOntoItIsThereInTheCushionsTime)
{
  const OnASlope scene;
  double height = Height;
  double time = 0.0;
  for (constexpr double step = 1e-5; height > 0.0 && time < 1.0; time += step)
  {
    height -= step * Settling * scene.Ground.Factor(OnASlope::Above(RestHeight + height), 55.0);
  }
  EXPECT_NEAR(time, 0.15, 0.03);
}

TEST(GroundEffect, WhatNothingAsksForIsBorneAtItsClearance)
{
  OnASlope scene;
  const double low = 0.5 * Length + 0.01; // m
  const double reach = 0.25 * Length;
  EXPECT_EQ(scene.Ground.Factor(OnASlope::Above(low), 100.0), 1.0) << "until it is told from when";
  scene.Ground.BearFrom(80.0);
  EXPECT_EQ(scene.Ground.Factor(OnASlope::Above(low), 79.5), 1.0);
  EXPECT_EQ(scene.Ground.Factor(OnASlope::Above(low + reach + 1e-9), 100.0), 1.0);
  EXPECT_NEAR(scene.Ground.Factor(OnASlope::Above(low), 100.0), 0.0, 1e-9);
  for (const double part : { 0.2, 0.5, 0.8 })
  {
    const Vec3 x = OnASlope::Above(low + part * reach);
    Vec3 gradient;
    EXPECT_NEAR(scene.Ground.Factor(x, 100.0, &gradient), part * part * (3.0 - 2.0 * part), 1e-6);
    for (int c = 0; c < 3; ++c)
    {
      const Vec3 h = 1e-6 * Vec3::Unit(c);
      const double slope =
        (scene.Ground.Factor(x + h, 100.0) - scene.Ground.Factor(x - h, 100.0)) / 2e-6;
      EXPECT_NEAR(gradient[c], slope, 1e-6) << part << " " << c;
    }
  }
}

/// A slope that moves by 0.6 m/s along x and 0.3 along y; it is landed on at frame 60, left at 70.
TEST(GroundEffect, WhatLandsTakesUpTheVelocityOfTheSurface)
{
  const OnASlope still;
  std::vector<ObstacleMesh> slope = still.Obstacles.Obstacles();
  const Vec3 step(0.02, 0.01, 0.0);
  for (int f = 0; f < 100; ++f)
  {
    slope.front().Offsets.push_back((f - 60) * step);
  }
  ObstacleSet moving;
  ASSERT_TRUE(moving.Build(slope));
  Constraint row;
  row.ObjectId = 0;
  row.Kind = ConstraintKind::Rest;
  row.Frame = 60;
  row.Until = 70;
  row.Value = slope.front().Offset(60) + Vec3(0.2, 0.1, 1.0);
  MotionObject body;
  body.RestHeight = RestHeight;
  body.ClearanceRadius = 0.5 * Length;
  body.SettlingSpeed = Settling;
  const std::vector<LandingWindow> landings = LandingWindows(body, { row }, moving, Rate);
  ASSERT_EQ(landings.size(), 1u);
  const GroundEffect ground(moving, landings, body, Rate,
                            [](const Vec3&, int) { return Vec3(0.0, 0.0, 0.0); });
  const Vec3 along = Rate * (step - step.dot(OnASlope::Normal()) * OnASlope::Normal());
  const auto carried = [&](double height, double frame)
  { return ground.Carried(landings[0].Centre.At(frame) + height * OnASlope::Normal(), frame); };
  EXPECT_GT(carried(1e-9, 59.5).dot(along), 0.75 * along.squaredNorm());
  EXPECT_LT(carried(0.5 * Height, 59.5).norm(), carried(0.1 * Height, 59.5).norm());
  EXPECT_EQ(carried(1.01 * Height, 59.5).norm(), 0.0);
  EXPECT_EQ(carried(0.0, 40.0).norm(), 0.0);
  EXPECT_LT((carried(0.0, 70.5) - along).norm(), 0.02 * along.norm());
  EXPECT_LT(carried(0.0, 86.0).norm(), 0.1 * along.norm());
  EXPECT_EQ(still.Windy.Carried(OnASlope::Above(RestHeight), 59.5).norm(), 0.0);
  for (const double frame : { 57.5, 76.5 })
  {
    const Vec3 x = landings[0].Centre.At(frame) + 0.4 * Height * OnASlope::Normal();
    Mat3 gradient = Mat3::Zero();
    (void)ground.Carried(x, frame, &gradient);
    EXPECT_GT(gradient.norm(), 0.1);
    for (int c = 0; c < 3; ++c)
    {
      constexpr double h = 1e-6;
      const Vec3 rise =
        ground.Carried(x + h * Vec3::Unit(c), frame) - ground.Carried(x - h * Vec3::Unit(c), frame);
      EXPECT_LT((gradient.col(c) - rise / (2.0 * h)).norm(), 1e-5) << frame;
    }
  }
}
