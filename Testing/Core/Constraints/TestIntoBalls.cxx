// SPDX-License-Identifier: BSD-3-Clause
// Paths that come into the balls of their rows, and bodies that are pushed out of them again.
#include "Constraints/IntoBalls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace waft;

namespace
{

constexpr double Step = 1.0 / 30.0; // s

std::vector<Vec3> Line(std::size_t frames)
{
  std::vector<Vec3> path;
  for (std::size_t f = 0; f < frames; ++f)
  {
    path.emplace_back(0.03 * static_cast<double>(f), 0.0, 1.0);
  }
  return path;
}

double MostAcceleration(const std::vector<Vec3>& x)
{
  double most = 0.0;
  for (std::size_t f = 1; f + 1 < x.size(); ++f)
  {
    most = std::max(most, (x[f - 1] - 2.0 * x[f] + x[f + 1]).norm() / (Step * Step));
  }
  return most;
}

void Bring(const std::vector<PositionBall>& balls, std::vector<Vec3>& path,
           std::vector<std::size_t> fixed = {})
{
  (void)MoveIntoBalls(
    balls,
    [&](std::size_t frame) { return std::find(fixed.begin(), fixed.end(), frame) != fixed.end(); },
    Step, [](std::vector<Vec3>&) {}, path);
}

} // namespace

TEST(IntoBalls, NoFrameIsMovedAlone)
{
  for (const double away : { 0.01, 0.1, 0.4 })
  {
    std::vector<Vec3> path = Line(90);
    const PositionBall ball{ 45, 0, path[45] + Vec3(0.0, 0.02 + away, 0.0), 0.02 };
    Bring({ ball }, path);
    EXPECT_NEAR((path[45] - ball.Center).norm(), ball.Radius, 1e-12) << away;
    EXPECT_LT(MostAcceleration(path), 6.5) << away;
    EXPECT_EQ(path.front(), Line(90).front()) << away;
    EXPECT_EQ(path.back(), Line(90).back()) << away;
  }
}

TEST(IntoBalls, WhatIsWithinStaysToTheBit)
{
  std::vector<Vec3> path = Line(30);
  EXPECT_FALSE(MoveIntoBalls(
    { { 12, 0, path[12] + Vec3(0.01, 0.0, 0.0), 0.02 } }, [](std::size_t) { return false; }, Step,
    [](std::vector<Vec3>&) { FAIL() << "nothing was moved"; }, path));
  EXPECT_EQ(path, Line(30));
}

TEST(IntoBalls, WhatStaysAndOtherBallsKeepTheirPlaces)
{
  std::vector<Vec3> path = Line(60);
  const std::vector<PositionBall> balls = { { 20, 0, path[20] + Vec3(0.0, 0.3, 0.0), 0.02 },
                                            { 26, 0, path[26] + Vec3(0.0, 0.01, 0.0), 0.02 },
                                            { 40, 0, path[40] + Vec3(0.0, 0.0, 0.2), 0.02 },
                                            { 42, 0, path[42] + Vec3(0.0, 0.0, 0.2), 0.02 } };
  Bring(balls, path, { 15, 42 });
  for (const std::size_t f : { std::size_t(15), std::size_t(26), std::size_t(42) })
  {
    EXPECT_EQ(path[f], Line(60)[f]) << f;
  }
  EXPECT_NEAR((path[20] - balls[0].Center).norm(), 0.02, 1e-12);
  EXPECT_NEAR((path[40] - balls[2].Center).norm(), 0.02, 1e-12);
  EXPECT_GT(path[18].y(), 0.05) << "it goes along";
  EXPECT_GT(path[23].y(), 0.05) << "it goes along";
}

TEST(IntoBalls, EndsOfAPathGoAlong)
{
  std::vector<Vec3> path = Line(40);
  Bring({ { 38, 0, path[38] + Vec3(0.0, 0.0, 0.32), 0.02 } }, path);
  EXPECT_GT(path[39].z(), 1.25);
  EXPECT_LT(MostAcceleration(path), 6.5);
}
