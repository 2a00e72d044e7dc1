// SPDX-License-Identifier: BSD-3-Clause
// Ways that obstacles leave open are found, and kept clear of, as measured without the planner's
// own distances.
#include "PlanScenes.h"
#include "Trajectory/Style.h"

#include <gtest/gtest.h>

#include <cstdio>

using namespace waft;
using namespace waft::test;

namespace
{

/// Signed distance to a box by its formula.
double BoxDistance(const Box& box, const Vec3& x)
{
  const Vec3 apart = (box.Min - x).cwiseMax(x - box.Max);
  return apart.cwiseMax(0.0).norm() + std::min(0.0, apart.maxCoeff());
}

/// Least distance minus radius of the swept centre, 8 positions a frame. All obstacles are boxes.
double LeastBoxSlack(const PlanScene& scene, const Track& track)
{
  std::vector<Box> boxes;
  for (const ObstacleMesh& obstacle : scene.Meshes)
  {
    Box box{ obstacle.Mesh.Points[0], obstacle.Mesh.Points[0] };
    for (const Vec3& x : obstacle.Mesh.Points)
    {
      box.Min = box.Min.cwiseMin(x);
      box.Max = box.Max.cwiseMax(x);
    }
    boxes.push_back(box);
  }
  double slack = 1e30;
  for (std::size_t k = 0; k + 1 < track.Positions.size(); ++k)
  {
    for (int i = 0; i <= 8; ++i)
    {
      const double u = i / 8.0;
      const Vec3 x = (1.0 - u) * track.Positions[k] + u * track.Positions[k + 1];
      double distance = scene.Scene.Bounds.InnerDistance(x);
      for (const Box& box : boxes)
      {
        distance = std::min(distance, BoxDistance(box, x));
      }
      slack = std::min(slack, distance - scene.Objects[track.ObjectId].ClearanceRadius);
    }
  }
  return slack;
}

/// Distance to a triangle: to its plane where the foot of the perpendicular lies inside, else to
/// its sides.
double TriangleDistance(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& x)
{
  const auto toSide = [&](const Vec3& from, const Vec3& to)
  {
    const Vec3 side = to - from;
    const double u = std::clamp((x - from).dot(side) / side.squaredNorm(), 0.0, 1.0);
    return (x - from - u * side).norm();
  };
  const Vec3 normal = (b - a).cross(c - a).normalized();
  const Vec3 foot = x - (x - a).dot(normal) * normal;
  const bool isInside = (b - a).cross(foot - a).dot(normal) >= 0.0 &&
                        (c - b).cross(foot - b).dot(normal) >= 0.0 &&
                        (a - c).cross(foot - c).dot(normal) >= 0.0;
  return isInside ? std::abs((x - a).dot(normal))
                  : std::min({ toSide(a, b), toSide(b, c), toSide(c, a) });
}

/// Least distance of the swept centre to any triangle, minus radius, 8 positions a frame. A centre
/// that begins outside and never comes near a surface stays outside.
double LeastMeshSlack(const PlanScene& scene, const Track& track)
{
  double slack = 1e30;
  for (std::size_t k = 0; k + 1 < track.Positions.size(); ++k)
  {
    for (int i = 0; i <= 8; ++i)
    {
      const double u = i / 8.0;
      const Vec3 x = (1.0 - u) * track.Positions[k] + u * track.Positions[k + 1];
      double distance = scene.Scene.Bounds.InnerDistance(x);
      for (const ObstacleMesh& obstacle : scene.Meshes)
      {
        const std::vector<Vec3>& p = obstacle.Mesh.Points;
        for (const auto& [a, b, c] : obstacle.Mesh.Triangles)
        {
          distance = std::min(distance, TriangleDistance(p[a], p[b], p[c], x));
        }
      }
      slack = std::min(slack, distance - scene.Objects[track.ObjectId].ClearanceRadius);
    }
  }
  return slack;
}

/// The factor that the report tells, 0 when it tells none.
double RetimingFactor(const ReportRow& line)
{
  const std::size_t offset = line.Message.find("retimed by ");
  double factor = 0.0;
  return offset != std::string::npos &&
             std::sscanf(line.Message.c_str() + offset, "retimed by %lf", &factor) == 1
           ? factor
           : 0.0;
}

TriangleMesh Boulder(Random& random)
{
  TriangleMesh mesh = MakeBox(Box{ Vec3(-1, -1, -1), Vec3(1, 1, 1) });
  for (int k = 0; k < 2; ++k)
  {
    mesh = Split(mesh);
  }
  const Mat3 turn =
    Eigen::AngleAxisd(random.Uniform(0.0, M_PI), random.Direction()).toRotationMatrix();
  const Vec3 size = random.InBox(Box{ Vec3(0.15, 0.15, 0.15), Vec3(0.7, 0.7, 0.7) });
  const Vec3 center = random.InBox(Box{ Vec3(-1.5, -1.5, 0.3), Vec3(1.5, 1.5, 3.4) });
  for (Vec3& x : mesh.Points)
  {
    x = center + turn * (size.cwiseProduct(x.normalized()) * random.Uniform(0.8, 1.1));
  }
  return mesh;
}

/// One object, a mark at a frame and one at 240, all three `clearance` from what stands there.
void FlyBetweenClearPoints(PlanScene& scene, Random& random, double clearance, int frame)
{
  const auto clearPoint = [&]()
  {
    Vec3 x;
    do
    {
      x = random.InBox(Box{ Vec3(-1.8, -1.8, 0.2), Vec3(1.8, 1.8, 3.8) });
    } while (scene.Obstacles.SignedDistance(x, 0.0) < clearance);
    return x;
  };
  scene.AddObject(clearPoint());
  scene.AddRow(ConstraintKind::Position, 0, frame, clearPoint());
  scene.AddRow(ConstraintKind::Position, 0, 240, clearPoint());
}

} // namespace

struct MazeCase
{
  const char* Name;
  int Frames;
  double Window;
};

class Mazes : public testing::TestWithParam<MazeCase>
{
};

TEST_P(Mazes, AreFlownThroughInTimeClearAndInStyle)
{
  PlanScene scene;
  MazeSize size;
  size.Window = GetParam().Window;
  AddMaze(scene, size);
  AddMazeFlight(scene, GetParam().Frames);
  StyleSamples style;
  int met = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    const PlanOutput output = scene.Run(seed);
    const Track& track = output.Tracks[0];
    ASSERT_EQ(track.Positions.size(), static_cast<std::size_t>(GetParam().Frames));
    EXPECT_GE(LeastBoxSlack(scene, track), -0.004) << seed;
    if (output.Report[0].Status == ConstraintStatus::Met)
    {
      ++met;
      EXPECT_EQ(track.Positions.back(), scene.Constraints[0].Value) << seed;
      EXPECT_NEAR(RetimingFactor(output.Report[0]), 1.0, 0.155) << seed;
    }
    AppendStyle(track.Positions, 1.0 / 30.0, style);
  }
  EXPECT_GE(met, 19);
  const StyleSamples reference = StyleOf(SwirlDatabase());
  EXPECT_LE(KolmogorovSmirnov(reference.LogCurvature, style.LogCurvature), 0.20);
  EXPECT_LE(KolmogorovSmirnov(reference.Acceleration, style.Acceleration), 0.35);
}

INSTANTIATE_TEST_SUITE_P(All, Mazes,
                         testing::Values(MazeCase{ "Wide", 300, 0.6 }, MazeCase{ "Fast", 200, 0.6 },
                                         MazeCase{ "Narrow", 300, 0.35 }),
                         [](const auto& info) { return info.param.Name; });

TEST(Mazes, WindowsHardlyWiderThanTwiceTheBodyAreFound)
{
  PlanScene scene;
  MazeSize size;
  size.Window = 0.26;
  AddMaze(scene, size);
  AddMazeFlight(scene, 300);
  int met = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
  {
    const PlanOutput output = scene.Run(seed);
    EXPECT_GE(LeastBoxSlack(scene, output.Tracks[0]), -0.004) << seed;
    met += output.Report[0].Status == ConstraintStatus::Met ? 1 : 0;
  }
  EXPECT_GE(met, 5);
}

TEST(Mazes, OneMoreSealedWallIsNamedAndEndsInTheLimitOfBranches)
{
  PlanScene scene;
  AddMaze(scene);
  AddMazeFlight(scene, 300);
  scene.AddBox(Vec3(1.40, -2.0, 0.0), Vec3(1.45, 2.0, 4.0));
  PlanOptions options;
  const PlanOutput output = scene.Run(options);
  EXPECT_EQ(output.Report[0].Status, ConstraintStatus::Unreachable);
  EXPECT_NE(output.Report[0].Message.find("no path found in the limits"), std::string::npos);
  EXPECT_GT(output.Report[0].Residual, 0.2);
  EXPECT_LT(output.Report[0].Residual, 3.4);
  EXPECT_LE(output.Trees.size(), static_cast<std::size_t>(options.MaximumNumberOfBranches) + 1);
  EXPECT_GE(LeastBoxSlack(scene, output.Tracks[0]), -0.004);
}

TEST(Mazes, NothingIsTouchedIn60RandomScenes)
{
  int met = 0;
  int rows = 0;
  double worst = 1e30;
  for (std::uint64_t seed = 1; seed <= 60; ++seed)
  {
    PlanScene scene;
    Random random(seed, 40);
    const int boxes = 2 + static_cast<int>(random.Index(8));
    for (int i = 0; i < boxes; ++i)
    {
      const Vec3 center = random.InBox(Box{ Vec3(-1.8, -1.8, 0.0), Vec3(1.8, 1.8, 3.5) });
      const Vec3 half = random.InBox(Box{ Vec3(0.05, 0.05, 0.1), Vec3(0.6, 0.6, 0.8) });
      scene.AddBox(center - half, center + half);
    }
    PlanScene::Check(scene.Obstacles.Build(scene.Meshes));
    FlyBetweenClearPoints(scene, random, 0.06, 110);
    const PlanOutput output = scene.Run(seed);
    const double slack = LeastBoxSlack(scene, output.Tracks[0]);
    worst = std::min(worst, slack);
    EXPECT_GE(slack, -0.004) << seed;
    EXPECT_LE(FastestStep(output.Tracks[0]), 1.5 * SwirlDatabase().TopSpeed) << seed;
    for (const ReportRow& line : output.Report)
    {
      ++rows;
      if (line.Status == ConstraintStatus::Met)
      {
        ++met;
        EXPECT_LE(line.Residual, 4e-9) << seed;
      }
    }
  }
  std::printf(
    "60 random scenes: %d of %d marks reached, least clearance beyond the radius %.2g m\n", met,
    rows, worst);
  EXPECT_GE(met, rows * 99 / 100);
}

TEST(Mazes, NothingIsTouchedAmongMeshesOfAnyShape)
{
  // Boulders (balls that were stretched, dented and turned), against brute force over all
  // triangles.
  int met = 0;
  int rows = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    PlanScene scene;
    Random random(seed, 41);
    for (int i = 0; i < 6; ++i)
    {
      ObstacleMesh obstacle;
      obstacle.ObstacleId = i + 1;
      obstacle.Mesh = Boulder(random);
      scene.Meshes.push_back(obstacle);
    }
    PlanScene::Check(scene.Obstacles.Build(scene.Meshes));
    FlyBetweenClearPoints(scene, random, 0.08, 120);
    const PlanOutput output = scene.Run(seed);
    EXPECT_GE(LeastMeshSlack(scene, output.Tracks[0]), -0.004) << seed;
    for (const ReportRow& line : output.Report)
    {
      ++rows;
      met += line.Status == ConstraintStatus::Met ? 1 : 0;
    }
  }
  EXPECT_GE(met, rows * 95 / 100);
}
