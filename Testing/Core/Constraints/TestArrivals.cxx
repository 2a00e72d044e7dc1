// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/Arrivals.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace waft;

namespace
{

std::vector<int> FramesAt(const std::vector<double>& parts, const FrameWindow& window,
                          TimeSpread spread = TimeSpread::Even)
{
  std::vector<int> frames;
  for (const double part : parts)
  {
    frames.push_back(FrameAt(window, spread, part));
  }
  return frames;
}

} // namespace

TEST(Arrivals, TheKthOfNComesAtItsPartOfTheWindow)
{
  const FrameWindow window{ 10, 50 };
  const std::vector<double> keys{ 3.0, 1.0, 2.0, 5.0, 4.0 };
  EXPECT_EQ(FramesAt(PartsByKey(keys), window), (std::vector<int>{ 30, 10, 20, 50, 40 }));
  // s(x) = x^2 and 1 - (1 - x)^2, rounded
  EXPECT_EQ(FramesAt(PartsByKey(keys), window, TimeSpread::EaseIn),
            (std::vector<int>{ 20, 10, 13, 50, 33 }));
  EXPECT_EQ(FramesAt(PartsByKey(keys), window, TimeSpread::EaseOut),
            (std::vector<int>{ 40, 10, 28, 50, 48 }));
  EXPECT_EQ(FramesAt(PartsByKey({ 7.0 }), window), std::vector<int>{ 10 });
  EXPECT_EQ(FramesAt(PartsByKey({ 0.0, 0.0, 0.0 }), { 4, 6 }), (std::vector<int>{ 4, 5, 6 }))
    << "equal ones as they are listed";
  EXPECT_EQ(FramesAt(PartsByKey(std::vector<double>(5, 0.0)), { 8, 9 }),
            (std::vector<int>{ 8, 8, 9, 9, 9 }))
    << "frames are shared where there are too few";
}

TEST(Arrivals, EqualRanksShareTheirFrame)
{
  EXPECT_EQ(FramesAt(PartsByRank({ 0, 3, 3, 0 }), { 0, 30 }), (std::vector<int>{ 0, 30, 30, 0 }));
  EXPECT_EQ(FramesAt(PartsByRank({ 2, 1, 0 }), { 0, 30 }), (std::vector<int>{ 30, 15, 0 }));
}

TEST(Arrivals, ByChanceIsAPermutationByTheSeed)
{
  std::vector<double> parts = PartsByChance(20, 7, 3);
  EXPECT_EQ(parts, PartsByChance(20, 7, 3));
  EXPECT_NE(parts, PartsByChance(20, 8, 3));
  EXPECT_NE(parts, PartsByChance(20, 7, 4));
  EXPECT_FALSE(std::is_sorted(parts.begin(), parts.end()));
  std::sort(parts.begin(), parts.end());
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    EXPECT_EQ(parts[k], PartOfRank(k, 20));
  }
}

TEST(Arrivals, GroupsComeOneAfterAnotherEachSpreadInItsPart)
{
  // Three letters with 3, 2 and 1 targets; the numbers of letters that have none are passed over.
  EXPECT_EQ(FramesAt(PartsByGroup({ 0, 4, 0, 9, 0, 4 }, TimeSpread::Even), { 0, 120 }),
            (std::vector<int>{ 0, 40, 20, 80, 40, 80 }));
}

TEST(Arrivals, SpreadsHaveTheirNames)
{
  for (const char* name : { "even", "ease-in", "ease-out" })
  {
    ASSERT_NE(FindTimeSpread(name), nullptr);
    EXPECT_EQ(ToString(*FindTimeSpread(name)), std::string(name));
  }
  EXPECT_EQ(FindTimeSpread("linear"), nullptr);
}
