// SPDX-License-Identifier: BSD-3-Clause
// Series of half floats are packed without loss, and what is no packed series is refused.
#include "Air/Field/PackedSeries.h"
#include "Base/Random.h"
#include "Base/ReadingStream.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

using namespace waft;

namespace
{

using Values = std::vector<std::vector<Half3>>;

std::vector<char> Pack(const Values& values)
{
  MemoryStream stream;
  WritePacked(stream, values);
  EXPECT_TRUE(stream.IsGood());
  return stream.Content;
}

void ExpectReadsBack(const Values& values)
{
  ReadingStream stream(Pack(values));
  Values read;
  ReadPacked(stream, read);
  EXPECT_TRUE(stream.IsGood());
  EXPECT_EQ(stream.Left(), 0U);
  EXPECT_EQ(read, values);
}

} // namespace

TEST(PackedSeries, AnyBitsReadBack)
{
  ExpectReadsBack({});
  ExpectReadsBack({ {}, {} });
  Random random(3);
  Values values(5, std::vector<Half3>(700));
  for (std::vector<Half3>& field : values)
  {
    for (Half3& value : field)
    {
      for (std::uint16_t& half : value)
      {
        half = static_cast<std::uint16_t>(65536.0 * random.Uniform()); // infinities, too
      }
    }
  }
  ExpectReadsBack(values);
}

TEST(PackedSeries, AnAirTakesHalfTheBytes)
{
  HalfSeries series;
  series.Dimensions = { 16, 16, 16 };
  series.Values.assign(30, std::vector<Half3>(4096));
  for (std::size_t k = 0; k < 30; ++k)
  {
    series.Times.push_back(static_cast<double>(k) / 30.0);
    HalfSeries::Field field;
    for (int i = 0; i < 4096; ++i)
    {
      const double phase = 0.13 * (i % 16) + 0.21 * ((i / 16) % 16) - 0.17 * (i / 256);
      const double t = 2.0 * series.Times[k];
      const double wave[] = { std::sin(phase + t), std::cos(2.0 * phase - t),
                              std::sin(phase - 1.3 * t) };
      field.push_back(
        { static_cast<float>(wave[0]), static_cast<float>(wave[1]), static_cast<float>(wave[2]) });
    }
    series.Set(k, field);
  }
  ExpectReadsBack(series.Values);
  EXPECT_LT(Pack(series.Values).size(), 30U * 4096U * sizeof(Half3) / 2U);
}

TEST(PackedSeries, DamagedBytesAreRefused)
{
  const std::vector<char> whole = Pack(Values(3, std::vector<Half3>(50, Half3{ 1, 2, 3 })));
  for (std::size_t length = 0; length < whole.size(); ++length)
  {
    ReadingStream stream(
      std::vector<char>(whole.begin(), whole.begin() + static_cast<long>(length)));
    Values read;
    ReadPacked(stream, read);
    EXPECT_FALSE(stream.IsGood()) << length;
  }
  // A number of points that the bytes cannot be: nothing is made room for.
  std::vector<char> many = whole;
  const std::uint64_t points = 1000000000;
  std::memcpy(many.data() + sizeof(std::uint64_t), &points, sizeof(points));
  ReadingStream stream(many);
  Values read;
  ReadPacked(stream, read);
  EXPECT_FALSE(stream.IsGood());
}
