// SPDX-License-Identifier: BSD-3-Clause
#include "Base/FieldSeries.h"
#include "Base/ForceFields.h"
#include "Base/Half.h"
#include "Base/HalfSeries.h"
#include "Base/Random.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace waft;

namespace
{

Vortex Slanted()
{
  Vortex vortex;
  vortex.P1 = Vec3(0.1, -0.2, 0.3);
  vortex.P2 = Vec3(0.4, 0.5, 2.6);
  vortex.Strength = -0.7;
  vortex.CenterTime = 2.0;
  vortex.Duration = 1.5;
  vortex.CoreRadius = 0.2;
  return vortex;
}

Mat3 CentralDifferences(const std::function<Vec3(const Vec3&)>& field, const Vec3& x, double h)
{
  Mat3 jacobian;
  for (int c = 0; c < 3; ++c)
  {
    Vec3 step = Vec3::Zero();
    step[c] = h;
    jacobian.col(c) = (field(x + step) - field(x - step)) / (2.0 * h);
  }
  return jacobian;
}

} // namespace

TEST(Vortex, JacobianEqualsCentralDifferences)
{
  const Vortex vortex = Slanted();
  Random random(3);
  const Box box{ Vec3(-1.0, -1.0, -0.5), Vec3(1.5, 1.5, 3.0) };
  for (int sample = 0; sample < 200; ++sample)
  {
    const Vec3 x = random.InBox(box);
    Mat3 jacobian;
    const Vec3 value = vortex.Acceleration(x, 1.3, jacobian);
    EXPECT_LT((value - vortex.Acceleration(x, 1.3)).norm(), 1e-14);
    const Mat3 expected =
      CentralDifferences([&](const Vec3& y) { return vortex.Acceleration(y, 1.3); }, x, 1e-5);
    EXPECT_LT((jacobian - expected).norm(), 1e-7 * (1.0 + expected.norm()));
  }
}

TEST(Vortex, IsFreeOfDivergenceAndVanishesOnItsAxis)
{
  const Vortex vortex = Slanted();
  Random random(5);
  const Box box{ Vec3(-1.0, -1.0, -0.5), Vec3(1.5, 1.5, 3.0) };
  for (int sample = 0; sample < 200; ++sample)
  {
    Mat3 jacobian;
    (void)vortex.Acceleration(random.InBox(box), 2.0, jacobian);
    EXPECT_NEAR(jacobian.trace(), 0.0, 1e-12 * (1.0 + jacobian.norm()));
  }
  for (const double s : { -0.5, 0.0, 0.3, 1.0, 1.7 })
  {
    const Vec3 onAxis = vortex.P1 + s * (vortex.P2 - vortex.P1);
    EXPECT_LT(vortex.Acceleration(onAxis, 2.0).norm(), 1e-12);
  }
}

TEST(Vortex, TurnsCounterClockwiseAboutItsAxis)
{
  Vortex vortex;
  vortex.P1 = Vec3(0.0, 0.0, 0.0);
  vortex.P2 = Vec3(0.0, 0.0, 2.0);
  vortex.CenterTime = 0.0;
  const Vec3 f = vortex.Acceleration(Vec3(0.5, 0.0, 1.0), 0.0);
  EXPECT_NEAR(f.x(), 0.0, 1e-15);
  EXPECT_GT(f.y(), 0.0);
  EXPECT_NEAR(f.z(), 0.0, 1e-15);
}

TEST(FieldSeries, ReproducesALinearFieldAndItsJacobian)
{
  FieldSeries field;
  field.Dimensions = { 4, 3, 5 };
  field.Origin = Vec3(-1.0, 0.5, 2.0);
  field.Spacing = Vec3(0.5, 0.25, 0.125);
  Mat3 a;
  a << 1.0, 2.0, -3.0, 0.5, -1.0, 4.0, 2.0, 0.25, 1.0;
  for (const double time : { 0.0, 2.0 })
  {
    std::vector<std::array<float, 3>> values;
    for (int k = 0; k < 5; ++k)
    {
      for (int j = 0; j < 3; ++j)
      {
        for (int i = 0; i < 4; ++i)
        {
          const Vec3 x = field.Origin + Vec3(i, j, k).cwiseProduct(field.Spacing);
          const Vec3 v = (1.0 + time) * (a * x);
          values.push_back({ float(v.x()), float(v.y()), float(v.z()) });
        }
      }
    }
    field.Times.push_back(time);
    field.Values.push_back(values);
  }
  ASSERT_TRUE(field.Validate("wind"));
  const Vec3 x(-0.3, 0.77, 2.31);
  Mat3 jacobian;
  const Vec3 value = field.Sample(x, 0.5, jacobian);
  EXPECT_LT((value - 1.5 * (a * x)).norm(), 1e-5);
  EXPECT_LT((jacobian - 1.5 * a).norm(), 1e-4);
  // Beyond the lattice and the times the nearest value holds.
  EXPECT_LT((field.Sample(Vec3(9.0, 9.0, 9.0), 7.0) - 3.0 * (a * Vec3(0.5, 1.0, 2.5))).norm(),
            1e-5);
}

TEST(FieldSeries, IsBetweenItsStepsAtAllPoints)
{
  FieldSeries field;
  EXPECT_TRUE(field.At(1.0).empty());
  field.Dimensions = { 2, 1, 1 };
  field.Times = { 1.0, 3.0 };
  field.Values = { { { 0.0f, 1.0f, 2.0f }, { 4.0f, 4.0f, 4.0f } },
                   { { 8.0f, 1.0f, 0.0f }, { 4.0f, 0.0f, 8.0f } } };
  EXPECT_EQ(field.At(0.0), field.Values[0]);
  EXPECT_EQ(field.At(3.0), field.Values[1]);
  EXPECT_EQ(field.At(9.0), field.Values[1]);
  EXPECT_EQ(field.At(1.5), (FieldSeries::Field{ { 2.0f, 1.0f, 1.5f }, { 4.0f, 3.0f, 5.0f } }));
}

TEST(HalfSeries, HasTheNearestHalfFloats)
{
  for (std::uint32_t bits = 0; bits < 0x7c00u; ++bits) // all that are finite
  {
    const auto half = static_cast<std::uint16_t>(bits);
    const float value = FromHalf(half);
    ASSERT_EQ(value, static_cast<float>(Eigen::numext::bit_cast<Eigen::half>(half)));
    ASSERT_EQ(ToHalf(value), half);
    ASSERT_EQ(FromHalf(ToHalf(-value)), -value);
  }
  Random random(3, 1);
  for (int k = 0; k < 100000; ++k)
  {
    const auto value = static_cast<float>(std::exp(random.Uniform(-20.0, 11.0)));
    ASSERT_EQ(FromHalf(ToHalf(value)), static_cast<float>(Eigen::half(value))) << value;
  }
  EXPECT_EQ(FromHalf(ToHalf(1e9f)), 65504.0f);
  EXPECT_EQ(FromHalf(ToHalf(-1e9f)), -65504.0f);
  EXPECT_EQ(std::abs(FromHalf(ToHalf(std::nanf("")))), 65504.0f);
}

TEST(HalfSeries, GivesTheStepsAroundATime)
{
  FieldSeries field;
  field.Dimensions = { 1, 1, 1 };
  field.Times = { 1.0, 2.0, 3.0 };
  field.Values = { { { 1.0f, 0.0f, 0.0f } }, { { 2.0f, 0.0f, 0.0f } }, { { 4.0f, 0.0f, 0.0f } } };
  const HalfSeries halves(field);
  for (const double time : { 0.0, 1.0, 1.4, 2.0, 2.5, 3.0, 4.0 })
  {
    EXPECT_EQ(halves.Around(time).At(time), field.At(time)) << time;
    EXPECT_LE(halves.Around(time).Values.size(), 2u);
  }
  EXPECT_TRUE(HalfSeries().Around(1.0).IsEmpty());
}

TEST(FieldSeries, NamesTheStepOfANumberThatIsNotFinite)
{
  FieldSeries field;
  field.Dimensions = { 2, 1, 1 };
  field.Times = { 0.0 };
  field.Values = { { { 0.f, 0.f, 0.f }, { 0.f, std::numeric_limits<float>::quiet_NaN(), 0.f } } };
  const Result result = field.Validate("Wind");
  EXPECT_FALSE(result);
  EXPECT_EQ(result.Message(),
            "Wind: step 0, point 1: expected a number from -1000000 to 1000000, found nan");
}

TEST(WindFront, PushesBehindItsEdge)
{
  WindFront front;
  front.Direction = Vec3::UnitY();
  front.Origin = Vec3(5.0, -1.0, 0.0);
  front.Speed = 2.0;
  front.Strength = 3.0;
  front.Width = 4.0;
  front.StartTime = 1.0;
  EXPECT_DOUBLE_EQ(2.0, front.PassesAt(Vec3(0.0, 1.0, 7.0)));
  const double time = 3.0; // the edge is at y = 3, the end at -1
  EXPECT_EQ(Vec3(Vec3::Zero()), front.Acceleration(Vec3(0.0, 3.01, 0.0), time));
  EXPECT_EQ(Vec3(Vec3::Zero()), front.Acceleration(Vec3(0.0, -1.01, 0.0), time));
  EXPECT_NEAR(1.5, front.Acceleration(Vec3(2.0, 2.75, 0.0), time).y(), 1e-12); // half up
  for (const double y : { -0.5, 1.0, 2.5 })
  {
    EXPECT_EQ(Vec3(0.0, 3.0, 0.0), front.Acceleration(Vec3(1.0, y, 4.0), time)) << y;
  }
}

TEST(AnalyticWind, FallsAsStated)
{
  AnalyticWind wind;
  wind.Direction = Vec3(0.0, 1.0, 0.0);
  wind.Strength = 2.0;
  wind.Radius = 0.5;
  wind.CenterTime = 1.0;
  wind.Duration = 2.0;
  EXPECT_NEAR(wind.Acceleration(Vec3::Zero(), 1.0).y(), 2.0, 1e-15);
  EXPECT_NEAR(wind.Acceleration(Vec3(0.5, 0.0, 0.0), 3.0).y(), 2.0 * std::exp(-1.0), 1e-15);
}
