// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Motion.h"

#include <gtest/gtest.h>

using namespace waft;

TEST(CentralVelocities, AreExactForAParabolaUpToTheEnds)
{
  const double step = 0.1;
  std::vector<Vec3> positions;
  for (int k = 0; k < 7; ++k)
  {
    const double t = k * step;
    positions.emplace_back(1.0 + 2.0 * t - 3.0 * t * t, t * t, -t);
  }
  const std::vector<Vec3> velocities = CentralVelocities(positions, step);
  ASSERT_EQ(velocities.size(), positions.size());
  for (int k = 0; k < 7; ++k)
  {
    const double t = k * step;
    EXPECT_LT((velocities[k] - Vec3(2.0 - 6.0 * t, 2.0 * t, -1.0)).norm(), 1e-13);
  }
}

TEST(CentralVelocities, OfOneAndTwoSamples)
{
  EXPECT_EQ(CentralVelocities({ Vec3::Ones() }, 0.5)[0], Vec3(Vec3::Zero()));
  const auto two = CentralVelocities({ Vec3::Zero(), Vec3::Ones() }, 0.5);
  EXPECT_EQ(two[0], Vec3(2.0, 2.0, 2.0));
  EXPECT_EQ(two[1], Vec3(2.0, 2.0, 2.0));
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
