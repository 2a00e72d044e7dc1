// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ResolveClearance.h"

#include "Base/Primitives.h"

#include <gtest/gtest.h>

using namespace waft;

namespace
{

constexpr int Frames = 61;

// A wall of 0.2 m across the middle of a room, and a leaf that flies from one end to the other.
struct Room
{
  explicit Room(const Box& wall)
  {
    ObstacleMesh mesh;
    mesh.Mesh = MakeBox(wall);
    EXPECT_TRUE(static_cast<bool>(this->Obstacles.Build({ mesh })));
    this->Leaf.ClearanceRadius = 0.1;
  }

  PathClearance Clearance() const
  {
    return { this->Obstacles, this->Volume, this->Landings, this->Leaf, 0.002 };
  }
  // Both ends stay.
  PathFreedom Freedom(const std::vector<Vec3>& path) const
  {
    PathFreedom freedom;
    freedom.Weights.assign(path.size(), 1.0);
    freedom.FrameStep = 1.0 / 30.0;
    freedom.MeetRows = [ends = std::pair(path.front(), path.back())](std::vector<Vec3>& x)
    {
      x.front() = ends.first;
      x.back() = ends.second;
    };
    return freedom;
  }
  // From the left to the right of the room, `aside` from the middle, by y, where the wall is.
  static std::vector<Vec3> Path(double aside)
  {
    std::vector<Vec3> path;
    for (int k = 0; k < Frames; ++k)
    {
      const double u = static_cast<double>(k) / (Frames - 1);
      path.emplace_back(-1.5 + 3.0 * u, aside * std::sin(EIGEN_PI * u), 2.0);
    }
    return path;
  }

  Box Volume{ Vec3(-2, -2, 0), Vec3(2, 2, 4) };
  ObstacleSet Obstacles;
  std::vector<LandingWindow> Landings;
  MotionObject Leaf;
};

double LargestStep(const std::vector<Vec3>& path)
{
  double largest = 0.0;
  for (std::size_t k = 1; k < path.size(); ++k)
  {
    largest = std::max(largest, (path[k] - path[k - 1]).norm());
  }
  return largest;
}

} // namespace

TEST(ResolveClearance, LeavesAPathThatIsClear)
{
  const Room room({ Vec3(-0.1, -0.5, 0), Vec3(0.1, 0.5, 3) });
  std::vector<Vec3> path = Room::Path(0.8);
  const std::vector<Vec3> before = path;
  EXPECT_TRUE(room.Clearance().BlockedSteps(path).empty());
  EXPECT_TRUE(ResolveClearance(room.Clearance(), room.Freedom(path), path, path));
  EXPECT_EQ(path, before);
}

TEST(ResolveClearance, PushesOutWhatGrazesSmoothly)
{
  const Room room({ Vec3(-0.1, -0.5, 0), Vec3(0.1, 0.5, 3) });
  std::vector<Vec3> path = Room::Path(0.57);
  const std::vector<Vec3> before = path;
  ASSERT_FALSE(room.Clearance().BlockedSteps(path).empty());
  // The fallback is not clear, so that it cannot be what helps.
  EXPECT_TRUE(ResolveClearance(room.Clearance(), room.Freedom(path), Room::Path(0.0), path));
  EXPECT_TRUE(room.Clearance().BlockedSteps(path).empty());
  EXPECT_EQ(path.front(), before.front());
  EXPECT_EQ(path.back(), before.back());
  EXPECT_LT(LargestStep(path), 1.3 * LargestStep(before));
  EXPECT_EQ(path[5], before[5]) << "far from the wall nothing moves";
}

TEST(ResolveClearance, GoesBackToTheFallbackWherePushingDoesNotHelp)
{
  // Through the middle of the wall: the nearest way out is back and forth.
  const Room room({ Vec3(-0.1, -1.0, 0), Vec3(0.1, 1.0, 3) });
  std::vector<Vec3> path = Room::Path(0.0);
  EXPECT_TRUE(ResolveClearance(room.Clearance(), room.Freedom(path), Room::Path(1.3), path));
  EXPECT_TRUE(room.Clearance().BlockedSteps(path).empty());
  EXPECT_NEAR(path[Frames / 2].y(), 1.3, 1e-9);
}

TEST(ResolveClearance, SaysWhereItCannotHelp)
{
  // The wall fills the room.
  const Room room({ Vec3(-0.1, -2.5, -1), Vec3(0.1, 2.5, 5) });
  std::vector<Vec3> path = Room::Path(0.0);
  EXPECT_FALSE(ResolveClearance(room.Clearance(), room.Freedom(path), Room::Path(1.0), path));
}

TEST(ResolveClearance, NothingMovesWhereWeightsAreZero)
{
  const Room room({ Vec3(-0.1, -0.5, 0), Vec3(0.1, 0.5, 3) });
  std::vector<Vec3> path = Room::Path(0.57);
  const std::vector<Vec3> before = path;
  PathFreedom freedom = room.Freedom(path);
  freedom.Weights.assign(path.size(), 0.0);
  EXPECT_FALSE(ResolveClearance(room.Clearance(), freedom, Room::Path(1.3), path));
  EXPECT_EQ(path, before);
}

TEST(ResolveClearance, NextToATightMarkOnlyItsOwnDistanceIsAskedFor)
{
  const Room room({ Vec3(-0.005, -0.5, 0), Vec3(0.005, 0.5, 3) });
  const std::vector<Vec3> path = Room::Path(0.57); // 0.07 m from the wall at the nearest
  PathClearance clearance = room.Clearance();
  ASSERT_FALSE(clearance.BlockedSteps(path).empty());
  clearance.TightMarks = { { Vec3(0, 0.57, 2), 0.065 } };
  EXPECT_TRUE(clearance.BlockedSteps(path).empty());
  EXPECT_NEAR(Required(room.Leaf, clearance.TightMarks, Vec3(0, 0.62, 2), Vec3(0.1, 0.62, 2)), 0.08,
              1e-12);
}

TEST(ResolveClearance, PushesOutOfWallsAndSurfacesThatAreLandedOn)
{
  Room room({ Vec3(-1, -1, 0), Vec3(1, 1, 1) });
  room.Leaf.RestHeight = 0.02;
  LandingWindow landing;
  landing.ObstacleId = 0;
  landing.Frame = landing.Until = 30;
  landing.First = 0;
  landing.Last = Frames;
  room.Landings = { landing };
  // Sinks by 0.05 m into the block under it, and by as much into the side of the room.
  std::vector<Vec3> path(Frames, Vec3(0, 0, 1.5));
  for (int k = 10; k < 20; ++k)
  {
    path[static_cast<std::size_t>(k)].z() = 0.95;
    path[static_cast<std::size_t>(k + 20)].y() = 1.95;
  }
  PathFreedom freedom = room.Freedom(path);
  freedom.Beyond = 0.001;
  EXPECT_TRUE(
    ResolveClearance(room.Clearance(), freedom, std::vector<Vec3>(Frames, Vec3(0, 0, -9)), path));
  EXPECT_GE(path[15].z(), 1.02);
  EXPECT_LE(path[35].y(), 1.9);
}
