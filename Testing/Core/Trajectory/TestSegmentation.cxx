// SPDX-License-Identifier: BSD-3-Clause
#include "Trajectory/Segmentation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

using namespace waft;

namespace
{

constexpr double Step = 1.0 / 30.0;

/// A planar path at 1 m/s whose direction turns by `angle` at each of k bends, smooth, with
/// straight stretches between; the bends' middles are at sample (i + 0.5) * spacing.
std::vector<Vec3> Bends(int k, int spacing, double angle, double width)
{
  std::vector<Vec3> path{ Vec3::Zero() };
  for (int i = 1; i < k * spacing; ++i)
  {
    double direction = 0.0;
    for (int bend = 0; bend < k; ++bend)
    {
      const double sign = bend % 2 == 0 ? 1.0 : -1.0;
      direction += sign * angle * 0.5 * (1.0 + std::tanh((i - (bend + 0.5) * spacing) / width));
    }
    path.push_back(path.back() + Step * Vec3(std::cos(direction), std::sin(direction), 0.0));
  }
  return path;
}

} // namespace

TEST(Segmentation, HelixCurvature)
{
  std::vector<Vec3> path;
  for (int i = 0; i < 50; ++i)
  {
    const double angle = 0.1 * i;
    path.emplace_back(0.5 * std::cos(angle), 0.5 * std::sin(angle), 0.2 * angle);
  }
  for (const double curvature : CurvatureAlong(path, Step))
  {
    EXPECT_NEAR(curvature, 0.5 / (0.25 + 0.04), 0.01 * 0.5 / 0.29);
  }
}

TEST(Segmentation, BendsAreParted)
{
  for (int k = 1; k <= 7; ++k)
  {
    const std::vector<double> curvature = CurvatureAlong(Bends(k, 30, 1.2, 3.0), Step);
    const std::vector<int> cuts = CutsBetweenFeatures(curvature, 1.0, 2.0);
    ASSERT_EQ(cuts.size(), static_cast<std::size_t>(k - 1));
    for (int i = 0; i + 1 < k; ++i)
    {
      EXPECT_NEAR(cuts[i], 30 * (i + 1), 4); // half way between two bends
    }
  }
  // A straight path has no feature and no cut.
  EXPECT_TRUE(CutsBetweenFeatures(std::vector<double>(50, 0.01), 1.0, 2.0).empty());
}

TEST(Segmentation, FeaturesStayWhole)
{
  SegmentationOptions options;
  const std::vector<double> curvature = CurvatureAlong(Bends(6, 30, 1.2, 3.0), Step);
  const std::vector<SampleRange> ranges = CutPath(curvature, options, 1.0);
  ASSERT_EQ(ranges.size(), 6u);
  for (int bend = 0; bend < 6; ++bend)
  {
    const int middle = 30 * bend + 15;
    EXPECT_LT(ranges[bend].First, middle - 5);
    EXPECT_GT(ranges[bend].First + ranges[bend].Count, middle + 6);
  }
}

TEST(Segmentation, RangesCoverThePathWithinTheLengths)
{
  SegmentationOptions options;
  for (int k = 1; k <= 12; ++k)
  {
    for (const int spacing : { 5, 9, 17, 70, 150 })
    {
      const std::vector<double> curvature = CurvatureAlong(Bends(k, spacing, 1.0, 2.0), Step);
      const std::vector<SampleRange> ranges = CutPath(curvature, options, 1.0);
      if (k * spacing < options.ShortestSegment)
      {
        EXPECT_TRUE(ranges.empty());
        continue;
      }
      int next = 0;
      for (const SampleRange& range : ranges)
      {
        EXPECT_EQ(range.First, next);
        EXPECT_GE(range.Count, options.ShortestSegment);
        EXPECT_LE(range.Count, options.LongestSegment);
        next = range.First + range.Count - 1;
      }
      EXPECT_EQ(next, k * spacing - 1);
    }
  }
}

TEST(Segmentation, LengthsAreGeometricAndTruncationKeepsTheBend)
{
  const std::vector<int> lengths = GroupLengths(SegmentationOptions());
  ASSERT_GE(lengths.size(), 4u);
  EXPECT_EQ(lengths.front(), 12);
  EXPECT_EQ(lengths.back(), 60);
  for (std::size_t i = 0; i + 1 < lengths.size(); ++i)
  {
    EXPECT_NEAR(double(lengths[i + 1]) / lengths[i], 1.5, 0.03);
  }
  std::vector<double> curvature(40, 0.0);
  for (int i = 28; i < 34; ++i)
  {
    curvature[i] = 1.0;
  }
  const SampleRange kept = Truncate({ 5, 35 }, 12, curvature);
  EXPECT_EQ(kept.Count, 12);
  EXPECT_LE(kept.First, 28);
  EXPECT_GE(kept.First + kept.Count, 34);
}
