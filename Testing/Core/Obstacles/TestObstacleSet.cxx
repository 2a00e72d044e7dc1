// SPDX-License-Identifier: BSD-3-Clause
#include "Obstacles/ObstacleSet.h"

#include "Base/Parallel.h"
#include "Base/Random.h"
#include "Obstacles/Shapes.h"

#include <gtest/gtest.h>

#include <limits>

using namespace waft;
using namespace waft::testing;

namespace
{

ObstacleMesh Still(int id, TriangleMesh mesh)
{
  ObstacleMesh obstacle;
  obstacle.ObstacleId = id;
  obstacle.Mesh = std::move(mesh);
  return obstacle;
}

ObstacleSet Built(std::vector<ObstacleMesh> obstacles)
{
  ObstacleSet set;
  const Result result = set.Build(std::move(obstacles));
  EXPECT_TRUE(static_cast<bool>(result)) << result.Message();
  return set;
}

double DistanceToBox(const Vec3& x, const Vec3& low, const Vec3& high)
{
  const Vec3 beyond = (low - x).cwiseMax(x - high);
  const double inside = beyond.maxCoeff();
  return inside < 0.0 ? inside : beyond.cwiseMax(0.0).norm();
}

/// Least distance of a swept ball's centre to a torus obstacle, by dense sampling.
double SampledClearance(const ObstacleSet& set, const Vec3& a, double frameA, const Vec3& b,
                        double frameB, int samples)
{
  double least = 1e30;
  for (int k = 0; k <= samples; ++k)
  {
    const double s = static_cast<double>(k) / samples;
    least = std::min(least, set.SignedDistance(a + s * (b - a), frameA + s * (frameB - frameA)));
  }
  return least;
}

/// Solid angle over 4 pi: 1 inside a closed surface, 0 outside.
double Winding(const TriangleMesh& mesh, const Vec3& x)
{
  double sum = 0.0;
  for (const auto& t : mesh.Triangles)
  {
    const Vec3 a = mesh.Points[t[0]] - x, b = mesh.Points[t[1]] - x, c = mesh.Points[t[2]] - x;
    sum += std::atan2(a.dot(b.cross(c)), a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                                           b.dot(c) * a.norm() + c.dot(a) * b.norm());
  }
  return sum / (2.0 * EIGEN_PI);
}

} // namespace

TEST(ObstacleSet, DistanceToABoxIsTheClosedForm)
{
  const Vec3 low(-0.3, 0.1, 0.2), high(0.9, 0.7, 1.1);
  const ObstacleSet set = Built({ Still(4, MakeBox({ low, high })) });
  Random random(1);
  for (int n = 0; n < 2000; ++n)
  {
    const Vec3 x = random.InBox({ Vec3(-1, -1, -1), Vec3(2, 2, 2) });
    const double expected = DistanceToBox(x, low, high);
    SurfaceHit hit;
    EXPECT_NEAR(set.SignedDistance(x, 0.0, hit), expected, 1e-12);
    EXPECT_EQ(hit.ObstacleId, 4);
    EXPECT_NEAR((x - expected * hit.Normal - hit.Point).norm(), 0.0, 1e-12);
    EXPECT_NEAR(set.SignedDistance(x, 0.0, 0.2), std::min(expected, 0.2), 1e-12);
    EXPECT_EQ(set.SignedDistance(x, 0.0, 0.2, 4), 0.2);
  }
}

TEST(ObstacleSet, InsideEqualsWindingNumberOnATorusWithRoundedSeam)
{
  const ObstacleSet set = Built({ Still(0, TorusMesh(Vec3(0.1, 0, 0), 1.0, 0.4, 40, 20)) });
  const TriangleMesh& mesh = set.Obstacles()[0].Mesh;
  Random random(2);
  int inside = 0;
  for (int n = 0; n < 1500; ++n)
  {
    Vec3 x = random.InBox({ Vec3(-1.5, -1.5, -0.5), Vec3(1.6, 1.5, 0.5) });
    if (n % 3 == 0)
    {
      x = mesh.Points[random.Index(static_cast<std::uint32_t>(mesh.Points.size()))] +
          Vec3(0, 0, random.Uniform(-0.2, 0.2)); // straight above and below vertices
    }
    const bool expected = Winding(mesh, x) > 0.5;
    inside += expected;
    const double distance = set.SignedDistance(x, 0.0);
    EXPECT_TRUE(std::abs(distance) < 1e-12 || (distance < 0.0) == expected) << x.transpose();
  }
  EXPECT_GT(inside, 300);
}

TEST(ObstacleSet, PointsAboveEdgesAndVerticesAreDecided)
{
  constexpr int n = 5;
  const ObstacleSet set = Built({ Still(0, StairsMesh(n)) });
  for (int i = -2; i <= 4 * n + 2; ++i)
  {
    for (int j = -2; j <= 4 * n + 2; ++j)
    {
      for (int k = -2; k <= 8 * n; ++k)
      {
        const Vec3 x(0.25 * i, 0.25 * j, 0.25 * k);
        // Brute force over the columns: distance to the nearest box of the union, if outside.
        double outside = 1e30;
        bool isInside = false;
        for (int a = 0; a < n; ++a)
        {
          for (int b = 0; b < n; ++b)
          {
            const double d = DistanceToBox(x, Vec3(a, b, 0), Vec3(a + 1, b + 1, a + b + 1));
            outside = std::min(outside, d);
            isInside = isInside || d < 0.0;
          }
        }
        const double distance = set.SignedDistance(x, 0.0);
        if (outside > 0.0)
        {
          ASSERT_NEAR(distance, outside, 1e-12) << x.transpose();
        }
        else if (isInside)
        {
          ASSERT_LT(distance, 0.0) << x.transpose();
        }
        SurfaceHit hit;
        const bool overColumn =
          i % 4 != 0 && j % 4 != 0 && i > 0 && j > 0 && i < 4 * n && j < 4 * n;
        if (overColumn && k >= 0)
        {
          ASSERT_TRUE(set.SurfaceBelow(x, 0.0, hit));
          ASSERT_NEAR(hit.Point.z(), i / 4 + j / 4 + 1, 1e-12) << x.transpose();
        }
      }
    }
  }
}

TEST(ObstacleSet, SweptBallAgreesWithDenseSampling)
{
  const ObstacleSet set = Built({ Still(0, TorusMesh(Vec3::Zero(), 1.0, 0.3, 32, 16)),
                                  Still(1, MakeBox({ Vec3(-2, -2, -1.2), Vec3(2, 2, -1.0) })) });
  Random random(3);
  int clear = 0, blocked = 0;
  for (int n = 0; n < 1000; ++n)
  {
    const Vec3 a = random.InBox({ Vec3(-2, -2, -1), Vec3(2, 2, 1) });
    const Vec3 b = a + random.Uniform(0.0, 1.0) * random.Direction();
    const double radius = n % 5 == 0 ? 0.0 : random.Uniform(0.0, 0.3);
    const double least = SampledClearance(set, a, 0, b, 0, 400);
    const bool result = set.IsClear(a, 0, b, 0, radius);
    (result ? clear : blocked)++;
    EXPECT_TRUE(result ? least >= radius - 1e-12 : least < radius + 1.3e-3)
      << least << " " << radius;
  }
  EXPECT_GT(clear, 200);
  EXPECT_GT(blocked, 200);
}

TEST(ObstacleSet, GrazingBallIsDecidedToRounding)
{
  const ObstacleSet set = Built({ Still(0, MakeBox({ Vec3(-1, -1, -1), Vec3(1, 1, 0) })) });
  for (const double radius : { 0.0, 0.1 })
  {
    const Vec3 up(0, 0, radius);
    const Vec3 a(-3, 0.2, 0), b(3, 0.3, 0);
    EXPECT_TRUE(set.IsClear(a + (1 + 1e-9) * up + Vec3(0, 0, 1e-12), 0,
                            b + (1 + 1e-9) * up + Vec3(0, 0, 1e-12), 0, radius));
    EXPECT_FALSE(set.IsClear(a + (1 - 1e-9) * up - Vec3(0, 0, 1e-12), 0,
                             b + (1 - 1e-9) * up - Vec3(0, 0, 1e-12), 0, radius));
  }
  // Wholly inside, touching nothing.
  EXPECT_FALSE(set.IsClear(Vec3(0, 0, -0.5), 0, Vec3(0.1, 0, -0.5), 0, 0.05));
}

TEST(ObstacleSet, MovingObstacleIsSeenInRelativeMotion)
{
  ObstacleMesh mover = Still(7, MakeBox({ Vec3(-0.2, -0.2, -0.2), Vec3(0.2, 0.2, 0.2) }));
  Random random(5);
  for (int f = 0; f < 12; ++f)
  {
    mover.Offsets.push_back(Vec3(0.3 * f - 1.5, 0.5 * std::sin(0.9 * f), 0.0));
  }
  const ObstacleSet set = Built({ mover });
  EXPECT_TRUE(set.HasMoving());
  // Both pass the same place, but at different times.
  const Vec3 place = mover.Offset(3.0);
  EXPECT_FALSE(set.IsClear(place, 2.5, place, 3.5, 0.05));
  EXPECT_TRUE(set.IsClear(place, 7.0, place, 11.0, 0.05));
  int clear = 0, blocked = 0;
  for (int n = 0; n < 800; ++n)
  {
    const Vec3 a = random.InBox({ Vec3(-2, -1, -0.5), Vec3(2, 1, 0.5) });
    const Vec3 b = a + random.Uniform(0.0, 2.0) * random.Direction();
    double frameA = random.Uniform(-2.0, 14.0);
    double frameB = frameA + random.Uniform(0.0, 6.0);
    if (n % 4 == 0)
    {
      std::swap(frameA, frameB);
    }
    const double radius = random.Uniform(0.0, 0.2);
    const double least = SampledClearance(set, a, frameA, b, frameB, 500);
    const bool result = set.IsClear(a, frameA, b, frameB, radius);
    (result ? clear : blocked)++;
    EXPECT_TRUE(result ? least >= radius - 1e-12 : least < radius + 1e-2);
  }
  EXPECT_GT(clear, 100);
  EXPECT_GT(blocked, 50);
}

TEST(ObstacleSet, TurnsInsideOutSurfacesAndUnderstandsCavities)
{
  TriangleMesh hollow = MakeBox({ Vec3(0, 0, 0), Vec3(3, 3, 3) });
  Turn(hollow);
  Append(hollow, MakeBox({ Vec3(1, 1, 1), Vec3(2, 2, 2) }));             // given facing outwards
  Append(hollow, MakeBox({ Vec3(1.4, 1.4, 1.4), Vec3(1.6, 1.6, 1.6) })); // an island in the cavity
  std::swap(hollow.Triangles[13][0], hollow.Triangles[13][1]);           // one triangle disagrees
  Append(hollow, MakeBox({ Vec3(5, 0, 0), Vec3(6, 1, 1) }));
  const ObstacleSet set = Built({ Still(0, hollow) });
  EXPECT_NEAR(set.SignedDistance(Vec3(1.5, 1.5, 0.5), 0), -0.5, 1e-12);
  EXPECT_NEAR(set.SignedDistance(Vec3(1.5, 1.5, 1.2), 0), 0.2, 1e-12);
  EXPECT_NEAR(set.SignedDistance(Vec3(1.5, 1.5, 1.5), 0), -0.1, 1e-12);
  EXPECT_NEAR(set.SignedDistance(Vec3(5.5, 0.5, 0.5), 0), -0.5, 1e-12);
  EXPECT_NEAR(set.SignedDistance(Vec3(4, 0.5, 0.5), 0), 1.0, 1e-12);
  const TriangleMesh& mesh = set.Obstacles()[0].Mesh;
  EXPECT_NEAR(Winding(mesh, Vec3(1.5, 1.5, 1.2)), 0.0, 1e-9);
  EXPECT_NEAR(Winding(mesh, Vec3(0.5, 0.5, 0.5)), 1.0, 1e-9);
}

TEST(ObstacleSet, RefusesWhatBoundsNoSolid)
{
  const auto message = [](TriangleMesh mesh)
  {
    ObstacleSet set;
    const Result result = set.Build({ Still(3, std::move(mesh)) });
    EXPECT_FALSE(static_cast<bool>(result));
    EXPECT_NE(result.Message().find("obstacle 3"), std::string::npos) << result.Message();
    EXPECT_TRUE(set.IsEmpty());
    return result.Message();
  };
  TriangleMesh open = MakeBox({ Vec3(0, 0, 0), Vec3(1, 1, 1) });
  open.Triangles.pop_back();
  EXPECT_NE(message(open).find("not closed: the edge from (1, 0, 0) to (1, 0, 1)"),
            std::string::npos)
    << message(open);
  TriangleMesh cutting = MakeBox({ Vec3(0, 0, 0), Vec3(1, 1, 1) });
  Append(cutting, MakeBox({ Vec3(0.5, 0.5, 0.5), Vec3(2, 2, 2) }));
  EXPECT_NE(message(cutting).find("cuts itself near"), std::string::npos);
  // One vertex pushed through the far side: some of what is cut has a corner in common with it.
  TriangleMesh pushed = MakeBox({ Vec3(0, 0, 0), Vec3(1, 1, 1) });
  pushed.Points[3] = Vec3(0.5, 0.6, 1.4);
  EXPECT_NE(message(pushed).find("cuts itself"), std::string::npos);
  EXPECT_NE(message({}).find("no triangles"), std::string::npos);
  TriangleMesh infinite = MakeBox({ Vec3(0, 0, 0), Vec3(1, 1, 1) });
  infinite.Points[2].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message(infinite).find("point 2 is not finite"), std::string::npos);
  TriangleMesh wild = MakeBox({ Vec3(0, 0, 0), Vec3(1, 1, 1) });
  wild.Triangles[5][1] = 8;
  EXPECT_NE(message(wild).find("triangle 5 names point 8"), std::string::npos);
  ObstacleSet kept = Built({ Still(1, MakeBox({ Vec3(0, 0, 0), Vec3(1, 1, 1) })) });
  EXPECT_FALSE(static_cast<bool>(kept.Build({ Still(1, open) })));
  EXPECT_LT(kept.SignedDistance(Vec3(0.5, 0.5, 0.5), 0), 0.0);
}

TEST(ObstacleSet, SurfaceBelowFindsTheTopOfWhatIsBelow)
{
  ObstacleMesh lift = Still(9, MakeBox({ Vec3(1, -0.5, 0.4), Vec3(2, 0.5, 0.6) }));
  lift.Offsets = { Vec3::Zero(), Vec3(0, 0, 0.5) };
  const ObstacleSet set =
    Built({ Still(0, MakeBox({ Vec3(-4, -4, -1), Vec3(4, 4, 0) })),
            Still(1, MakeBox({ Vec3(-1, -1, -0.2), Vec3(1, 1, 0.3) })),
            Still(2, MakeBox({ Vec3(-1, -1, 0.3), Vec3(0, 0, 0.5) })), lift });
  SurfaceHit hit;
  const auto height = [&](double x, double y, double z, double frame)
  {
    EXPECT_TRUE(set.SurfaceBelow(Vec3(x, y, z), frame, hit));
    EXPECT_NEAR((hit.Point.head<2>() - Eigen::Vector2d(x, y)).norm(), 0.0, 1e-15);
    EXPECT_NEAR(hit.Normal.z(), 1.0, 1e-12);
    return hit.Point.z();
  };
  EXPECT_NEAR(height(3, 3, 2, 0), 0.0, 1e-12);
  EXPECT_NEAR(height(0, 0, 2, 0), 0.3, 1e-12); // on an edge of box 2 and on diagonals
  EXPECT_EQ(hit.ObstacleId, 1);
  EXPECT_NEAR(height(-0.5, -0.5, -0.5, 0), 0.5, 1e-12); // from within three solids that touch
  EXPECT_EQ(hit.ObstacleId, 2);
  EXPECT_NEAR(height(1.5, 0, 2, 0.5), 0.85, 1e-12);
  EXPECT_EQ(hit.ObstacleId, 9);
  EXPECT_NEAR(height(1.5, 0, 0.3, 0.5), 0.0, 1e-12); // below the lift
  EXPECT_FALSE(set.SurfaceBelow(Vec3(0, 0, -2), 0, hit));
  EXPECT_FALSE(set.SurfaceBelow(Vec3(5, 0, 2), 0, hit));
}

TEST(ObstacleSet, QueriesFromTwoThreadsAreTheSame)
{
  const ObstacleSet set = Built({ Still(0, TorusMesh(Vec3::Zero(), 1.0, 0.3, 32, 16)) });
  std::vector<double> one(4000), two(4000);
  const auto fill = [&](std::vector<double>& out, const ParallelFor& loop)
  {
    loop(out.size(),
         [&](std::size_t begin, std::size_t end)
         {
           for (std::size_t n = begin; n < end; ++n)
           {
             Random random(9, n);
             const Vec3 x = random.InBox({ Vec3(-2, -2, -1), Vec3(2, 2, 1) });
             out[n] = set.SignedDistance(x, 0) + set.IsClear(x, 0, Vec3::Zero(), 0, 0.1);
           }
         });
  };
  fill(one, SerialFor());
  fill(two, ThreadedFor(2));
  EXPECT_EQ(one, two);
}
