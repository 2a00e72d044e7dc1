// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Motion.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace waft;

TEST(CentralDifferences, AreExactForAParabolaUpToTheEnds)
{
  const double step = 0.1;
  std::vector<Vec3> positions;
  for (int k = 0; k < 7; ++k)
  {
    const double t = k * step;
    positions.emplace_back(1.0 + 2.0 * t - 3.0 * t * t, t * t, -t);
  }
  const std::vector<Vec3> velocities = CentralDifferences(positions, step);
  ASSERT_EQ(velocities.size(), positions.size());
  for (int k = 0; k < 7; ++k)
  {
    const double t = k * step;
    EXPECT_LT((velocities[k] - Vec3(2.0 - 6.0 * t, 2.0 * t, -1.0)).norm(), 1e-13);
  }
}

TEST(CentralDifferences, OfOneAndTwoSamples)
{
  EXPECT_EQ(CentralDifferences({ Vec3::Ones() }, 0.5)[0], Vec3(Vec3::Zero()));
  const auto two = CentralDifferences({ Vec3::Zero(), Vec3::Ones() }, 0.5);
  EXPECT_EQ(two[0], Vec3(2.0, 2.0, 2.0));
  EXPECT_EQ(two[1], Vec3(2.0, 2.0, 2.0));
}

TEST(CentralDifferences, BeginWhereTheObjectComesIntoTheShot)
{
  Track track;
  MotionObject object;
  object.ObjectId = 7;
  object.Release = 3;
  object.Appears = 1;
  track.TakeTimes(object);
  EXPECT_EQ(3, track.FirstPresent);
  EXPECT_FALSE(track.IsPresent(2));
  EXPECT_TRUE(track.IsPresent(3));
  for (int k = 0; k < 7; ++k)
  {
    const double t = 0.1 * std::max(k - 3, 0);
    track.Positions.emplace_back(2.0 * t - 3.0 * t * t, t * t, -t);
  }
  const std::vector<Vec3> velocities = CentralVelocities(track, 0.1);
  for (int k = 0; k < 7; ++k)
  {
    const double t = 0.1 * (k - 3);
    const Vec3 wanted = k < 3 ? Vec3(Vec3::Zero()) : Vec3(2.0 - 6.0 * t, 2.0 * t, -1.0);
    EXPECT_LT((velocities[static_cast<std::size_t>(k)] - wanted).norm(), 1e-13) << k;
  }
  object.Appears = 0; // it hangs there
  track.TakeTimes(object);
  EXPECT_EQ(0, track.FirstPresent);
  EXPECT_EQ(3, track.Release);
}

TEST(Track, EndsWhereTheObjectIsGone)
{
  Track track;
  track.Leave = 4;
  track.Fade = 2;
  for (int k = 0; k < 6; ++k)
  {
    track.Positions.emplace_back(0.1 * std::min(k, 3), 0.0, 0.0);
  }
  const std::vector<Vec3> velocities = CentralVelocities(track, 0.1);
  for (std::size_t k = 0; k < 6; ++k)
  {
    EXPECT_EQ(k < 4, track.IsPresent(k));
    EXPECT_NEAR(k < 4 ? 1.0 : 0.0, velocities[k].x(), 1e-12) << k;
  }
  EXPECT_EQ(1.0, track.SizeAt(2));
  EXPECT_EQ(0.5, track.SizeAt(3));
  EXPECT_EQ(0.0, track.SizeAt(4));
  EXPECT_TRUE(track.ComesOrGoes());
}

TEST(ObstacleMesh, MovesBetweenItsFrames)
{
  ObstacleMesh obstacle;
  EXPECT_EQ(obstacle.Offset(3.5), Vec3(Vec3::Zero()));
  obstacle.Offsets = { Vec3::Zero(), Vec3(2.0, 0.0, 0.0), Vec3(2.0, 4.0, 0.0) };
  EXPECT_EQ(obstacle.Offset(0.5), Vec3(1.0, 0.0, 0.0));
  EXPECT_EQ(obstacle.Offset(1.25), Vec3(2.0, 1.0, 0.0));
  EXPECT_EQ(obstacle.Offset(99.0), Vec3(2.0, 4.0, 0.0));
}
