// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Random.h"
#include "Trajectory/Style.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace waft;

TEST(Style, HelixHasItsCurvatureSpeedAndAcceleration)
{
  const double radius = 0.4;
  const double pitch = 0.1; // rise per radian
  const double omega = 3.0;
  const double step = 1.0 / 30.0;
  std::vector<Vec3> path;
  for (int i = 0; i < 60; ++i)
  {
    const double angle = omega * step * i;
    path.emplace_back(radius * std::cos(angle), radius * std::sin(angle), pitch * angle);
  }
  StyleSamples samples;
  AppendStyle(path, step, samples);
  ASSERT_EQ(samples.Speed.size(), 58u);
  const double curvature = radius / (radius * radius + pitch * pitch);
  for (std::size_t i = 0; i < samples.Speed.size(); ++i)
  {
    EXPECT_NEAR(std::exp(samples.LogCurvature[i]), curvature, 0.01 * curvature);
    EXPECT_NEAR(samples.Speed[i], omega * std::hypot(radius, pitch), 0.01);
    EXPECT_NEAR(samples.Acceleration[i], omega * omega * radius, 0.01 * omega * omega * radius);
  }
  StyleSamples part;
  AppendStyle(path, step, 10, 20, part);
  EXPECT_EQ(part.Speed.size(), 10u);
}

TEST(Style, KolmogorovSmirnovOfKnownPopulations)
{
  EXPECT_EQ(KolmogorovSmirnov({ 1, 2, 3 }, { 3, 1, 2 }), 0.0);
  EXPECT_EQ(KolmogorovSmirnov({ 1, 2 }, { 3, 4 }), 1.0);
  EXPECT_EQ(KolmogorovSmirnov({ 1, 2, 3, 4 }, { 3, 4, 5, 6 }), 0.5);
  EXPECT_EQ(KolmogorovSmirnov({}, { 1 }), 1.0);
  Random random(1);
  std::vector<double> a;
  std::vector<double> b;
  for (int i = 0; i < 20000; ++i)
  {
    a.push_back(random.Uniform());
    b.push_back(random.Uniform(0.25, 1.25));
  }
  EXPECT_NEAR(KolmogorovSmirnov(a, b), 0.25, 0.02);
}

TEST(Style, QuantileIsLinearBetweenRanks)
{
  EXPECT_EQ(Quantile({ 3, 1, 2 }, 0.5), 2.0);
  EXPECT_EQ(Quantile({ 0, 10 }, 0.95), 9.5);
  EXPECT_EQ(Quantile({}, 0.5), 0.0);
}
