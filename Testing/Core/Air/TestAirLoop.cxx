// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/AirLoop.h"

#include "Air/Field/WindCorrection.h"
#include "Base/Random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace waft
{
namespace
{

/// Fields of chance that go over into each other in ten frames.
HalfSeries Wandering(int frames)
{
  HalfSeries air;
  air.Meaning = FieldMeaning::Velocity;
  air.Dimensions = { 12, 12, 12 };
  air.Spacing = Vec3::Constant(0.1);
  Random random(5);
  std::vector<HalfSeries::Field> keys(static_cast<std::size_t>(frames / 10 + 2));
  for (HalfSeries::Field& key : keys)
  {
    key.resize(air.NumberOfPoints());
    for (std::array<float, 3>& u : key)
    {
      u = { static_cast<float>(random.Normal()), static_cast<float>(random.Normal()),
            static_cast<float>(random.Normal()) };
    }
  }
  for (int f = 0; f < frames; ++f)
  {
    const double turn = 0.5 * std::acos(-1.0) * (f % 10) / 10.0; // of one rms
    HalfSeries::Field field = keys[static_cast<std::size_t>(f / 10)];
    const HalfSeries::Field& next = keys[static_cast<std::size_t>(f / 10 + 1)];
    for (std::size_t i = 0; i < field.size(); ++i)
    {
      for (std::size_t c = 0; c < 3; ++c)
      {
        field[i][c] =
          static_cast<float>(std::cos(turn) * field[i][c] + std::sin(turn) * next[i][c]);
      }
    }
    air.Times.push_back(f / 30.0);
    air.Values.emplace_back();
    air.Set(static_cast<std::size_t>(f), field);
  }
  return air;
}

double Difference(const HalfSeries::Field& a, const HalfSeries::Field& b)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      sum += std::pow(a[i][c] - b[i][c], 2);
    }
  }
  return std::sqrt(sum / (3.0 * static_cast<double>(a.size())));
}

TEST(AirLoop, JoinsTheEndsOfAnAir)
{
  const HalfSeries drawn = Wandering(61 + 20);
  HalfSeries air = drawn;
  JoinEnds(60, SerialFor(), air);
  ASSERT_EQ(air.Values.size(), 61u);
  ASSERT_EQ(air.Times.size(), 61u);
  EXPECT_EQ(air.Values.front(), air.Values.back());
  const HalfSeries::Field none(air.NumberOfPoints(), { 0.0f, 0.0f, 0.0f });
  double longest = 0.0;
  for (std::size_t f = 0; f < 60; ++f)
  {
    longest = std::max(longest, Difference(drawn.At(f), drawn.At(f + 1)));
  }
  for (std::size_t f = 0; f < 60; ++f)
  {
    EXPECT_NEAR(Difference(air.At(f), none), 1.0, 0.03) << f; // as strong as it was
    EXPECT_LT(Difference(air.At(f), air.At(f + 1)), 1.6 * longest) << f;
  }
  EXPECT_LT(Difference(air.At(0), drawn.At(60)), 1e-3); // after the last frame as it was drawn
  EXPECT_EQ(air.Values[40], drawn.Values[40]);
}

TEST(AirLoop, BendsAnAirThatEndsNearlyAsItBegins)
{
  const HalfSeries ends = Wandering(91);
  HalfSeries air = ends;
  BendEnds(30.0, SerialFor(), air);
  EXPECT_EQ(air.Values.front(), air.Values.back());
  EXPECT_EQ(air.Values[60], ends.Values[60]);
  EXPECT_LT(Difference(air.At(61), ends.At(61)), 1e-2);
}

/// A flow round the middle of the volume, along its walls, once there and back in 90 frames.
Vec3 Swirl(const Vec3& x, double frame)
{
  const double quarter = 0.25 * std::acos(-1.0);
  const double a = quarter * x.x(), b = quarter * x.y();
  return 0.5 * std::cos(8.0 * quarter * frame / 90.0) *
         Vec3(-std::cos(a) * std::cos(a) * std::sin(2.0 * b),
              std::sin(2.0 * a) * std::cos(b) * std::cos(b), 0.0);
}

TEST(AirLoop, ItsCorrectionGoesOnAsItBegins)
{
  const Timeline time{ 91, 30.0 };
  const Box volume{ Vec3(-2, -2, 0), Vec3(2, 2, 4) };
  WindCorrection wind(volume, time, { { 0.8, 0.5, 0.1 }, { 0.4, 0.3, 0.05 } }, nullptr, true, true);
  Random random(3);
  std::vector<WindSamples> samples;
  for (int f = 0; f < 90; f += 3)
  {
    samples.emplace_back();
    samples.back().Frame = f + 0.5;
    for (int k = 0; k < 60; ++k)
    {
      samples.back().Positions.push_back(random.InBox(volume));
      samples.back().Values.push_back(Swirl(samples.back().Positions.back(), f + 0.5));
    }
  }
  SilentMonitor monitor;
  ASSERT_TRUE(wind.Fit(samples, 0.05, 3e-3, 60, SerialFor(), monitor));
  HalfSeries air;
  air.Meaning = FieldMeaning::Velocity;
  air.Dimensions = { 9, 9, 9 };
  air.Origin = volume.Min;
  air.Spacing = Vec3::Constant(0.5);
  for (const int frame : { 0, 44, 89, 90 })
  {
    air.Times.push_back(time.Time(frame));
    air.Values.emplace_back();
    air.Set(air.Values.size() - 1, HalfSeries::Field(air.NumberOfPoints(), { 0.0f, 0.0f, 0.0f }));
  }
  ASSERT_TRUE(wind.AddTo(air, air, ThreadedFor(2), monitor));
  EXPECT_EQ(air.Values[0], air.Values[3]);
  for (int s = 0; s < 50; ++s)
  {
    const Vec3 x = random.InBox({ Vec3(-1.2, -1.2, 0.8), Vec3(1.2, 1.2, 3.2) });
    EXPECT_LT((wind.At(x, 0.0) - wind.At(x, 90.0)).norm(), 1e-12);
    const Vec3 after = wind.At(x, 0.01) - wind.At(x, 0.0);
    const Vec3 before = wind.At(x, 90.0) - wind.At(x, 89.99);
    EXPECT_LT((after - before).norm(), 0.05 * after.norm() + 1e-6);
    EXPECT_LT((wind.At(x, 0.0) - Swirl(x, 0.0)).norm(), 0.15);
    EXPECT_LT((air.Around(time.Time(89)).Sample(air.PointAt(400), time.Time(89)) -
               wind.At(air.PointAt(400), 89.0))
                .norm(),
              2e-3);
  }
}

} // namespace
} // namespace waft
