// SPDX-License-Identifier: BSD-3-Clause
#include "Base/BodyLaw.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace waft;

namespace
{

BodyLaw Gliding()
{
  BodyLaw law = BodyLaw::Sinking(0.5);
  law.Slip.x() = 0.3;
  return law;
}

} // namespace

TEST(BodyLaw, OfItselfGoesWithTheAir)
{
  const Vec3 air(0.3, -0.2, 0.1);
  EXPECT_EQ(BodyLaw().Velocity(air), air);
  EXPECT_EQ(BodyLaw().SettlingSpeed(), 0.0);
  EXPECT_EQ(BodyLaw().ResponseTime(StandardGravity), 0.0);
}

TEST(BodyLaw, SinksByWhatTheGroundLeavesOfItsSlip)
{
  const BodyLaw law = BodyLaw::Sinking(0.5);
  EXPECT_EQ(law.SettlingSpeed(), 0.5);
  EXPECT_EQ(law.Velocity(Vec3::Zero()), Vec3(0.0, 0.0, -0.5));
  EXPECT_EQ(law.Velocity(Vec3(1.0, 2.0, 3.0), 0.5), Vec3(1.0, 2.0, 2.75));
  EXPECT_EQ(law.Velocity(Vec3(1.0, 2.0, 3.0), -1.5), Vec3(1.0, 2.0, 3.75)); // lifted
  EXPECT_EQ(Gliding().Velocity(Vec3(1.0, 2.0, 3.0), 0.5), Vec3(0.85, 2.0, 2.75));
}

// v' = (u - s - v) / T from rest in still air: weight alone at first, the settling speed at last.
TEST(BodyLaw, FallsFreelyAtFirstAndSteadilyInTheEnd)
{
  const BodyLaw law = BodyLaw::Sinking(0.8);
  const double response = law.ResponseTime(StandardGravity);
  const Vec3 first = law.Velocity(Vec3::Zero()) / response;
  EXPECT_LT((first + StandardGravity * Vec3::UnitZ()).norm(), 1e-12);
  Vec3 v = Vec3::Zero();
  const double step = 1e-3 * response;
  for (int k = 0; k < 1000; ++k)
  {
    v += step * (law.Velocity(Vec3::Zero()) - v) / response;
  }
  EXPECT_NEAR(v.z(), -0.8 * (1.0 - std::exp(-1.0)), 1e-3);
  EXPECT_EQ(law.Velocity(Vec3::Zero()).z(), -0.8);
}

TEST(BodyLaw, ItsRateIsFiniteForWhatDoesNotSettle)
{
  const BodyLaw law = BodyLaw::Sinking(0.8);
  EXPECT_NEAR(law.ResponseRate(StandardGravity) * law.ResponseTime(StandardGravity), 1.0, 1e-15);
  EXPECT_NEAR(law.ResponseRate(StandardGravity / 30.0), law.ResponseRate(StandardGravity) / 30.0,
              1e-12); // a frame
  EXPECT_TRUE(std::isfinite(BodyLaw().ResponseRate(StandardGravity)));
}

TEST(BodyLaw, ItsGradientIsThatOfItsVelocity)
{
  const BodyLaw law = Gliding();
  Mat3 air;
  air << 0.25, 0.0, -1.0, 0.5, 2.0, 0.0, 1.0, 0.0, 0.5;
  const Vec3 slope(0.1, -0.4, 3.0);
  const auto velocity = [&](const Vec3& x) { return law.Velocity(air * x, 0.5 + slope.dot(x)); };
  const Mat3 gradient = law.VelocityGradient(air, slope);
  for (int c = 0; c < 3; ++c)
  {
    const Vec3 change = velocity(0.5 * Vec3::Unit(c)) - velocity(-0.5 * Vec3::Unit(c));
    EXPECT_LT((gradient.col(c) - change).norm(), 1e-14) << c;
  }
}

TEST(BodyLaw, IsTheSameInOtherUnits)
{
  constexpr double spacing = 0.25, frame = 1.0 / 30.0;
  const Vec3 air(0.3, -0.2, 0.1);
  const Vec3 there = Gliding().In(spacing, frame).Velocity(air * frame / spacing, 0.7);
  EXPECT_LT((there - Gliding().Velocity(air, 0.7) * frame / spacing).norm(), 1e-15);
}

TEST(BodyLaw, IsMadeFromAnObjectAndHowItTurnsFromAShape)
{
  MotionObject leaf;
  leaf.SettlingSpeed = 0.7;
  EXPECT_EQ(LawOf(leaf).Slip, Vec3(0.0, 0.0, 0.7));
  Shape shape;
  shape.DragCoefficient = 1.1;
  shape.Damping = 0.4;
  EXPECT_EQ(TurningLawOf(shape).Drag, 1.1);
  EXPECT_EQ(TurningLawOf(shape).Damping, 0.4);
}
