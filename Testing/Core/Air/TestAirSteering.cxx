// SPDX-License-Identifier: BSD-3-Clause
// What steers an air, by the fast loops and by plain ones: the same bits.
#include "Air/Field/AirSteering.h"
#include "Base/Random.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace waft;

namespace
{

using Field = AirSteering::Field;

constexpr double Rate = 5.0;

HalfSeries SomeAir(std::uint64_t seed, std::size_t frames)
{
  HalfSeries air;
  air.Meaning = FieldMeaning::Velocity;
  air.Dimensions = { 9, 6, 5 };
  air.Spacing = Vec3(0.11, 0.13, 0.17);
  Random random(seed);
  for (std::size_t f = 0; f < frames; ++f)
  {
    air.Times.push_back(0.04 * static_cast<double>(f) + 0.001 * random.Uniform());
    air.Values.emplace_back();
    Field field(air.NumberOfPoints());
    for (std::array<float, 3>& value : field)
    {
      for (float& component : value)
      {
        component = static_cast<float>(2.0 * random.Uniform() - 1.0);
      }
    }
    air.Set(f, field);
  }
  return air;
}

Field PlainDerivative(const HalfSeries& air, std::size_t f)
{
  Field derivative(air.NumberOfPoints());
  const std::array<int, 3>& n = air.Dimensions;
  const std::ptrdiff_t stride[3] = { 1, n[0], static_cast<std::ptrdiff_t>(n[0]) * n[1] };
  const std::size_t before = f > 0 ? f - 1 : 0;
  const std::size_t after = std::min(f + 1, air.Values.size() - 1);
  const double time = air.Times[after] - air.Times[before];
  const Field now = air.At(f), earlier = air.At(before), later = air.At(after);
  for (std::ptrdiff_t p = 0; p < static_cast<std::ptrdiff_t>(derivative.size()); ++p)
  {
    const std::ptrdiff_t index[3] = { p % n[0], p / stride[1] % n[1], p / stride[2] };
    const auto at = static_cast<std::size_t>(p);
    for (std::size_t c = 0; c < 3; ++c)
    {
      double d = time > 0.0 ? (later[at][c] - earlier[at][c]) / time : 0.0;
      for (int axis = 0; axis < 3; ++axis)
      {
        const int low = index[axis] > 0 ? -1 : 0;
        const int high = index[axis] + 1 < n[static_cast<std::size_t>(axis)] ? 1 : 0;
        const auto a = static_cast<std::size_t>(p + low * stride[axis]);
        const auto b = static_cast<std::size_t>(p + high * stride[axis]);
        d += now[at][static_cast<std::size_t>(axis)] * (now[b][c] - now[a][c]) /
             (std::max(1, high - low) * air.Spacing[axis]);
      }
      derivative[at][c] = static_cast<float>(d);
    }
  }
  return derivative;
}

Field PlainMeans(const std::array<int, 3>& n, Field field)
{
  const std::ptrdiff_t stride[3] = { 1, n[0], static_cast<std::ptrdiff_t>(n[0]) * n[1] };
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const Field before = field;
    for (std::ptrdiff_t p = 0; p < static_cast<std::ptrdiff_t>(field.size()); ++p)
    {
      const std::ptrdiff_t at = p / stride[axis] % n[axis];
      const bool first = at == 0;
      const bool last = at + 1 == n[axis];
      const auto low = static_cast<std::size_t>(first ? p + stride[axis] : p - stride[axis]);
      const auto high = static_cast<std::size_t>(last ? p - stride[axis] : p + stride[axis]);
      for (std::size_t c = 0; c < 3; ++c)
      {
        const float mean = 0.25f * (before[low][c] + before[high][c]) +
                           0.5f * before[static_cast<std::size_t>(p)][c];
        field[static_cast<std::size_t>(p)][c] = (first || last) && c == axis ? 0.0f : mean;
      }
    }
  }
  return field;
}

// The push at a frame before it is smoothed, and after.
Field PlainPush(const HalfSeries& wanted, const HalfSeries& own, const Field& now, std::size_t f)
{
  const Field asked = PlainDerivative(wanted, f), driven = PlainDerivative(own, f);
  const Field goal = wanted.At(f);
  Field sum(now.size());
  for (std::size_t i = 0; i < sum.size(); ++i)
  {
    for (std::size_t c = 0; c < 3; ++c)
    {
      const float feed = asked[i][c] - driven[i][c];
      sum[i][c] = feed + static_cast<float>(Rate) * (goal[i][c] - now[i][c]);
    }
  }
  return PlainMeans(wanted.Dimensions, PlainMeans(wanted.Dimensions, sum));
}

} // namespace

TEST(AirSteering, IsThatOfPlainLoops)
{
  for (const std::size_t frames : { std::size_t{ 1 }, std::size_t{ 2 }, std::size_t{ 6 } })
  {
    const HalfSeries wanted = SomeAir(1, frames), own = SomeAir(2, frames);
    const HalfSeries now = SomeAir(4, frames);
    for (const int threads : { 1, 3 })
    {
      AirSteering steering(wanted, own, Rate);
      for (std::size_t f = 0; f < frames; ++f)
      {
        const FieldSeries found = steering.At(static_cast<int>(f), now.At(f), ThreadedFor(threads));
        EXPECT_EQ(found.Values[0], PlainPush(wanted, own, now.At(f), f)) << f;
      }
    }
  }
}

TEST(AirSteering, MayBeginAtAnyFrame)
{
  const HalfSeries wanted = SomeAir(1, 6), own = SomeAir(2, 6);
  const Field now = SomeAir(4, 1).At(0);
  AirSteering steering(wanted, own, Rate);
  EXPECT_EQ(steering.At(3, now, SerialFor()).Values[0], PlainPush(wanted, own, now, 3));
}
