// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Primitives.h"
#include "Scene/BlueNoise.h"
#include "Scene/LetterSpacing.h"
#include "Scene/StrokeThinning.h"
#include "Scene/SurfaceSampling.h"
#include "Scene/TargetSampling.h"
#include "TestAssets.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace waft;

namespace
{

TargetMask Filled(int width, int height)
{
  TargetMask mask;
  mask.Width = width;
  mask.Height = height;
  mask.Weights.assign(static_cast<std::size_t>(width) * height, 1.f);
  return mask;
}

double NearestPair(const std::vector<PlaneTarget>& targets)
{
  double nearest = 1e300;
  for (std::size_t i = 0; i < targets.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      nearest =
        std::min(nearest, std::hypot(targets[i].X - targets[j].X, targets[i].Y - targets[j].Y));
    }
  }
  return nearest;
}

} // namespace

TEST(StrokeThinning, LeavesTheMiddleOfABar)
{
  std::vector<char> bar(40 * 12, 0);
  for (int y = 3; y < 8; ++y)
  {
    for (int x = 5; x < 35; ++x)
    {
      bar[y * 40 + x] = 1;
    }
  }
  const auto thin = ThinStrokes(bar, 40, 12);
  int count = 0;
  for (int y = 0; y < 12; ++y)
  {
    for (int x = 0; x < 40; ++x)
    {
      if (thin[y * 40 + x])
      {
        ++count;
        EXPECT_EQ(y, 5);
      }
    }
  }
  EXPECT_GT(count, 22);
  EXPECT_LE(count, 30);
}

TEST(LetterSpacing, MovesLettersApartAndKeepsThem)
{
  // Two bars 3 wide and 2 apart, a dot above the second one.
  Picture text;
  text.Width = 8;
  text.Height = 12;
  for (int y = 0; y < 12; ++y)
  {
    for (int x = 0; x < 8; ++x)
    {
      const bool ink = x < 3 ? y < 10 : x > 4 && (y < 8 || y > 9);
      text.Pixels.push_back({ 0.f, 0.f, 0.f, ink ? 1.f : 0.f });
    }
  }
  const Picture spread = SpreadLetters(text, 6.0);
  ASSERT_EQ(spread.Width, 12);
  for (int y = 0; y < 12; ++y)
  {
    for (int x = 0; x < 12; ++x)
    {
      const bool ink = x < 3 ? y < 10 : x > 8 && (y < 8 || y > 9);
      EXPECT_EQ(spread.Pixels[y * 12 + x][3], ink ? 1.f : 0.f) << x << " " << y;
    }
  }
  EXPECT_EQ(SpreadLetters(text, 1.0).Pixels, text.Pixels);
}

TEST(TargetSampling, AFilledSquareBecomesAnEvenSpread)
{
  const TargetMask mask = Filled(120, 120);
  std::vector<PlaneTarget> targets;
  ASSERT_TRUE(SampleMask(mask, 49, {}, 3, 0, targets));
  ASSERT_EQ(targets.size(), 49u);
  EXPECT_GT(NearestPair(targets), 0.7 * PackingDistance(1.0, 2, 49));
  double x = 0.0;
  double y = 0.0;
  for (const PlaneTarget& t : targets)
  {
    EXPECT_LT(std::abs(t.X), 0.5);
    EXPECT_LT(std::abs(t.Y), 0.5);
    x += t.X / 49.0;
    y += t.Y / 49.0;
  }
  EXPECT_NEAR(x, 0.0, 0.02);
  EXPECT_NEAR(y, 0.0, 0.02);
}

TEST(TargetSampling, FollowsTheWeights)
{
  TargetMask mask = Filled(150, 75);
  for (int y = 0; y < 75; ++y)
  {
    for (int x = 0; x < 75; ++x)
    {
      mask.Weights[y * 150 + x] = 1.f / 3.f;
    }
  }
  std::vector<PlaneTarget> targets;
  ASSERT_TRUE(SampleMask(mask, 120, {}, 3, 0, targets));
  const auto left =
    std::count_if(targets.begin(), targets.end(), [](const PlaneTarget& t) { return t.X < 0.0; });
  // A quarter of the weight; a tessellation shifts a little from thick to thin.
  EXPECT_GT(left, 24);
  EXPECT_LT(left, 45);
}

TEST(TargetSampling, WhatIsWiderThanAStrokeLiesOnItsMiddleLine)
{
  TargetMask mask = Filled(200, 20);
  std::vector<PlaneTarget> targets;
  const auto mostAside = [&]
  {
    double most = 0.0;
    for (const PlaneTarget& t : targets)
    {
      most = std::max(most, 200.0 * std::abs(t.Y));
    }
    return most;
  };
  ASSERT_TRUE(SampleMask(mask, 30, {}, 1, 0, targets));
  EXPECT_GT(mostAside(), 4.0) << "points, 6 pixels apart in single file, have room beside another";
  mask.BodyWidth = 24.0;
  ASSERT_TRUE(SampleMask(mask, 30, {}, 1, 0, targets));
  ASSERT_EQ(targets.size(), 30u);
  EXPECT_LT(mostAside(), 1.6);
  EXPECT_GT(200.0 * NearestPair(targets), 0.7 * 180.0 / 29.0);
}

TEST(TargetSampling, ThinStrokesGetTheirEndsAndEvenDistances)
{
  Picture picture;
  ASSERT_TRUE(TestAssets().DrawText("L", "sans", picture));
  std::vector<PlaneTarget> targets;
  ASSERT_TRUE(SampleMask(MaskFromPicture(picture, {}), 8, {}, 1, 0, targets));
  ASSERT_EQ(targets.size(), 8u);
  // In pixels: the strokes' middle lines are x = 5 and y = 5.
  double highest = 0.0;
  double rightmost = 0.0;
  for (const PlaneTarget& t : targets)
  {
    const double x = 60.0 * (t.X + 0.5);
    const double y = 60.0 * t.Y + 50.0;
    EXPECT_LT(std::min(std::abs(x - 5.0), std::abs(y - 5.0)), 1.6) << x << " " << y;
    highest = std::max(highest, y);
    rightmost = std::max(rightmost, x);
  }
  EXPECT_GT(highest, 90.0);
  EXPECT_GT(rightmost, 50.0);
  EXPECT_GT(60.0 * NearestPair(targets), 0.75 * 145.0 / 8.0);
}

TEST(TargetSampling, ClassesKeepToTheirColoursAndLimits)
{
  Picture picture;
  ASSERT_TRUE(TestAssets().LoadPicture("", picture));
  const TargetMask mask = MaskFromPicture(picture, { { 0.9, 0.1, 0.1 }, { 0.1, 0.1, 0.9 } });
  std::vector<PlaneTarget> targets;
  ASSERT_TRUE(SampleMask(mask, 30, { 12, 40 }, 1, 0, targets));
  ASSERT_EQ(targets.size(), 30u);
  int red = 0;
  for (const PlaneTarget& t : targets)
  {
    red += t.Class == 0;
    EXPECT_EQ(t.Class == 0, t.X < 0.0);
    EXPECT_LT(std::abs(t.X), 0.455);
    EXPECT_LT(std::abs(t.Y), 0.155);
  }
  EXPECT_EQ(red, 12);
  const Result tooFew = SampleMask(mask, 30, { 12, 4 }, 1, 0, targets);
  EXPECT_FALSE(tooFew);
  EXPECT_NE(tooFew.Message().find("found 16"), std::string::npos) << tooFew.Message();
}

TEST(TargetSampling, DarkOnLightAndLightOnDarkAreTheSame)
{
  Picture dark;
  dark.Width = 20;
  dark.Height = 20;
  Picture light = dark;
  for (int i = 0; i < 400; ++i)
  {
    const bool drawn = i / 20 > 5 && i / 20 < 14 && i % 20 > 5 && i % 20 < 14;
    const float d = drawn ? 0.f : 1.f;
    dark.Pixels.push_back({ d, d, d, 1.f });
    light.Pixels.push_back({ 1.f - d, 1.f - d, 1.f - d, 1.f });
  }
  EXPECT_EQ(MaskFromPicture(dark, {}).Weights, MaskFromPicture(light, {}).Weights);
  EXPECT_FALSE(MaskFromPicture(dark, {}).IsEmpty());
  for (auto& pixel : dark.Pixels)
  {
    pixel = { 0.5f, 0.5f, 0.5f, 1.f };
  }
  EXPECT_TRUE(MaskFromPicture(dark, {}).IsEmpty());
}

TEST(TargetSampling, ASurfaceIsSampledByArea)
{
  const TriangleMesh box = MakeBox(Box{ Vec3(0.0, 0.0, 0.0), Vec3(4.0, 4.0, 0.001) });
  std::vector<Vec3> points;
  ASSERT_TRUE(SampleSurface(box, 100, 2, 0, points));
  ASSERT_EQ(points.size(), 100u);
  const auto top =
    std::count_if(points.begin(), points.end(), [](const Vec3& p) { return p.z() > 0.0009; });
  EXPECT_GT(top, 35);
  EXPECT_LT(top, 65);
  TriangleMesh nothing;
  EXPECT_FALSE(SampleSurface(nothing, 5, 2, 0, points));
}

TEST(TargetMask, APictureThatIsClearInACornerOnlyIsWarnedOf)
{
  Picture picture;
  picture.Width = 100;
  picture.Height = 100;
  picture.Pixels.assign(10000, { 0.5f, 0.5f, 0.5f, 1.0f });
  EXPECT_EQ(RemarkOnTransparency(picture), "");
  picture.Pixels[0][3] = 0.0f;
  EXPECT_EQ(RemarkOnTransparency(picture).find("only 0.01 % of the picture are transparent"), 0u);
  for (std::size_t i = 0; i < 600; ++i)
  {
    picture.Pixels[i][3] = 0.0f;
  }
  EXPECT_EQ(RemarkOnTransparency(picture), "");
}
