// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Primitives.h"
#include "Base/Random.h"
#include "Scene/BlueNoise.h"
#include "Scene/MeshQueries.h"
#include "Scene/NearObjects.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace waft;

namespace
{

double NearestPair(const std::vector<Vec3>& points)
{
  double nearest = 1e300;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      nearest = std::min(nearest, (points[i] - points[j]).norm());
    }
  }
  return nearest;
}

bool Anywhere(const Vec3&)
{
  return true;
}

} // namespace

TEST(BlueNoise, PointsAreFarApartInOneTwoAndThreeDimensions)
{
  const Box boxes[] = { { Vec3(0.0, 0.0, 0.0), Vec3(4.0, 0.0, 0.0) },
                        { Vec3(0.0, 0.0, 1.0), Vec3(3.0, 2.0, 1.0) },
                        { Vec3(-1.0, -1.0, 0.0), Vec3(1.0, 1.0, 2.0) } };
  const double measures[] = { 4.0, 6.0, 8.0 };
  for (int d = 0; d < 3; ++d)
  {
    const auto points = SpreadInBox(boxes[d], 60, 5, 0, Anywhere);
    ASSERT_EQ(points.size(), 60u);
    // White noise of 60 points has its nearest pair at a few percent of the packing distance.
    EXPECT_GT(NearestPair(points), 0.5 * PackingDistance(measures[d], d + 1, 60));
    EXPECT_EQ(points, SpreadInBox(boxes[d], 60, 5, 0, Anywhere));
    EXPECT_NE(points, SpreadInBox(boxes[d], 60, 6, 0, Anywhere));
  }
}

TEST(BlueNoise, KeepsToAdmissiblePlaces)
{
  const Box box{ Vec3(0.0, 0.0, 0.0), Vec3(1.0, 1.0, 1.0) };
  for (const Vec3& p : SpreadInBox(box, 40, 1, 0, [](const Vec3& x) { return x.x() > 0.9; }))
  {
    EXPECT_GT(p.x(), 0.9);
  }
  EXPECT_TRUE(SpreadInBox(box, 40, 1, 0, [](const Vec3&) { return false; }).empty());
}

TEST(BlueNoise, LaterPointsKeepAwayFromEarlierOnes)
{
  const Box box{ Vec3(-1.0, -1.0, 0.0), Vec3(1.0, 1.0, 2.0) };
  std::vector<Vec3> all = SpreadInBox(box, 20, 5, 0, Anywhere);
  const auto more = SpreadInBox(box, 20, 5, 1, Anywhere, all);
  all.insert(all.end(), more.begin(), more.end());
  EXPECT_GT(NearestPair(all), 0.45 * PackingDistance(8.0, 3, 40));
}

TEST(MeshQueries, BallsAgainstABoxAndASphere)
{
  const TriangleTree box(MakeBox(Box{ Vec3(0.0, 0.0, 0.0), Vec3(1.0, 2.0, 3.0) }));
  EXPECT_FALSE(IsOutside(box, Vec3(0.5, 1.0, 1.5), 0.1)); // wholly inside
  EXPECT_TRUE(IsOutside(box, Vec3(0.5, 1.0, 3.2), 0.19));
  EXPECT_FALSE(IsOutside(box, Vec3(0.5, 1.0, 3.2), 0.21));
  // Beyond an edge and a corner the distance is Pythagoras'.
  EXPECT_TRUE(IsOutside(box, Vec3(1.3, 2.4, 1.0), 0.499));
  EXPECT_FALSE(IsOutside(box, Vec3(1.3, 2.4, 1.0), 0.501));
  EXPECT_TRUE(IsOutside(box, Vec3(2.0, 4.0, 5.0), 2.999));
  EXPECT_FALSE(IsOutside(box, Vec3(2.0, 4.0, 5.0), 3.001));
  const TriangleTree sphere(MakeSphere(Vec3(1.0, 0.0, 0.0), 0.5));
  Random random(2);
  for (int i = 0; i < 200; ++i)
  {
    const double r = random.Uniform(0.0, 1.5);
    const Vec3 x = Vec3(1.0, 0.0, 0.0) + r * random.Direction();
    if (std::abs(r - 0.6) > 0.01)
    {
      EXPECT_EQ(IsOutside(sphere, x, 0.1), r > 0.6);
    }
  }
}

TEST(NearObjects, AgreeWithALookAtAll)
{
  Random random(7);
  for (const double scale : { 0.0, 1e-3, 1.0 })
  {
    NearObjects near;
    std::vector<std::pair<Vec3, double>> all;
    const Box box{ Vec3(-1, -1, -1), Vec3(1, 1, 1) };
    for (int i = 0; i < 500; ++i)
    {
      const Vec3 x = random.InBox(box);
      const double radius = scale * random.Uniform(0.0, i % 100 == 0 ? 0.3 : 0.02);
      const bool hasRoom = std::all_of(all.begin(), all.end(),
                                       [&](const auto& ball)
                                       { return (ball.first - x).norm() >= radius + ball.second; });
      EXPECT_EQ(near.HasRoom(x, radius), hasRoom);
      EXPECT_EQ(near.HasRoom(x, 50.0 * radius + 0.01),
                std::all_of(all.begin(), all.end(),
                            [&](const auto& ball) {
                              return (ball.first - x).norm() >= 50.0 * radius + 0.01 + ball.second;
                            }));
      near.Add(x, radius);
      all.emplace_back(x, radius);
    }
    EXPECT_EQ(near.Count(), 500u);
  }
}
