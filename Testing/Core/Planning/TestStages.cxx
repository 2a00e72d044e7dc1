// SPDX-License-Identifier: BSD-3-Clause
// Free flight, refinement, clearance, repair and seams: each stage on its own.
#include "Planning/ClearPath.h"
#include "Planning/Refinement.h"
#include "Planning/Seams.h"

#include "Base/Primitives.h"
#include "RandomChains.h"

#include <gtest/gtest.h>

using namespace waft;
using namespace waft::test;

TEST(FreeFlight, LastsItsFramesInsideTheVolume)
{
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    const PieceChain chain = RandomChain(seed);
    ASSERT_GE(chain.Pieces.size(), 3u);
    EXPECT_NEAR(chain.NumberOfSamples(Library().Window()) - 1, 240, 6);
    for (const Piece& piece : chain.Pieces)
    {
      for (int k = piece.First; k < piece.Last - 8; ++k)
      {
        EXPECT_GT(Box().InnerDistance(piece.Transform * Library().Samples(piece.Segment)[k]), 0.05);
      }
    }
  }
}

TEST(Refinement, NeverRaisesTheCostAndOftenLowersIt)
{
  int lowered = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    PieceChain chain = RandomChain(seed);
    const PieceChain before = chain;
    const RefinementResult result = RefineChain(Library(), 0.2, chain);
    EXPECT_LE(result.CostAfter, result.CostBefore + 1e-12);
    lowered += result.CostAfter < 0.95 * result.CostBefore ? 1 : 0;
    double sum = 0.0;
    for (std::size_t i = 1; i < chain.Pieces.size(); ++i)
    {
      sum += ConnectionCost(Library(), chain.Pieces[i - 1], chain.Pieces[i]);
      EXPECT_EQ(Library().Samples(chain.Pieces[i].Segment).size(),
                Library().Samples(before.Pieces[i].Segment).size());
    }
    EXPECT_NEAR(sum, result.CostAfter, 1e-12);
  }
  EXPECT_GT(lowered, 10);
}

TEST(Refinement, FindsAPlantedPerfectSegment)
{
  // The middle piece is one of its cluster's children; put the representative in its place.
  const SegmentLibrary& library = Library();
  const MotionDatabase& database = library.Database();
  int tried = 0;
  for (int top = 0; top < library.NumberOfTops() && tried < 10; ++top)
  {
    const ClusterNode& node = database.Nodes[database.TopNodes[top]];
    if (node.FirstChild < 0)
    {
      continue;
    }
    const int planted = database.Nodes[node.FirstChild + node.NumberOfChildren - 1].Medoid;
    if (planted == node.Medoid)
    {
      continue;
    }
    // Neighbours cut out of the planted segment itself continue it without any residual.
    const auto last = static_cast<int>(library.Samples(planted).size()) - 1;
    const int window = library.Window();
    PieceChain chain;
    chain.Pieces = { { planted, top, 0, window - 1, {} },
                     { node.Medoid, top, 0, last, {} },
                     { planted, top, last - (window - 1), last, {} } };
    chain.JoinIndex = 3;
    const RefinementResult result = RefineChain(library, 10.0, chain);
    EXPECT_EQ(chain.Pieces[1].Segment, planted);
    EXPECT_LT(result.CostAfter, 1e-12);
    EXPECT_GT(result.CostBefore, 1e-4);
    ++tried;
  }
  EXPECT_GE(tried, 3);
}

TEST(Clearance, SkippingFindsTheHitsThatEverySampleFinds)
{
  std::vector<ObstacleMesh> meshes(1);
  meshes[0].Mesh = MakeBox(Box{ Vec3(-0.3, -0.4, 0.0), Vec3(0.3, 0.5, 2.0) });
  ObstacleSet obstacles;
  ASSERT_TRUE(bool(obstacles.Build(meshes)));
  ClearanceField field;
  field.Obstacles = &obstacles;
  Random random(2);
  int hits = 0;
  for (int trial = 0; trial < 100; ++trial)
  {
    std::vector<Vec3> path{ random.InBox(Box{ Vec3(-1, -1, 0.5), Vec3(1, 1, 3) }) };
    Vec3 velocity = 0.02 * random.Direction();
    for (int k = 0; k < 80; ++k)
    {
      velocity += 0.002 * random.Direction();
      path.push_back(path.back() + velocity);
    }
    bool any = false;
    for (std::size_t k = 0; k < path.size(); ++k)
    {
      any = any || field.Distance(path[k], 0.0) < field.Rule.Radius + 0.01;
    }
    EXPECT_EQ(field.FirstHit(path, 0, 80, 0.0, 1.0, 0.01) >= 0, any);
    hits += any ? 1 : 0;
  }
  EXPECT_GT(hits, 20);
  EXPECT_LT(hits, 95);
}

TEST(ClearPath, EasesAPathOutOfABox)
{
  std::vector<ObstacleMesh> meshes(1);
  meshes[0].Mesh = MakeBox(Box{ Vec3(-0.2, -2.0, 0.0), Vec3(0.2, 2.0, 2.0) });
  ObstacleSet obstacles;
  ASSERT_TRUE(bool(obstacles.Build(meshes)));
  ClearanceField field;
  field.Obstacles = &obstacles;
  WarpProblem warp;
  warp.SecondDifferences.assign(101, Vec3::Zero());
  warp.IsFixed.assign(101, 0);
  warp.Fixed.assign(101, Vec3::Zero());
  warp.IsFixed[0] = warp.IsFixed[100] = 1;
  warp.Fixed[0] = Vec3(-1.5, 0.0, 1.98);
  warp.Fixed[100] = Vec3(1.5, 0.0, 1.98);
  const std::vector<Vec3> path = SolveWarp(warp);
  const PathClearance clearance{ obstacles, field.Bounds, field.Landings, field.Rule, 0.001 };
  ASSERT_FALSE(clearance.BlockedSteps(path).empty());
  ClearPathOptions options;
  options.Tolerance = 0.001;
  PathShortfall shortfall;
  const std::vector<Vec3> repaired = ClearPath(field, warp, options, path, path, shortfall);
  EXPECT_TRUE(clearance.BlockedSteps(repaired).empty());
  EXPECT_EQ(shortfall.Frame, -1);
  EXPECT_EQ(repaired.front(), path.front());
  for (const Vec3& bend : SecondDifferences(repaired))
  {
    EXPECT_LT(bend.norm(), 0.01);
  }
}

TEST(Seams, AreHandedOverWithoutAJumpOfAcceleration)
{
  // Two flights that bend against each other, and a given stretch at the end.
  WarpProblem warp;
  warp.SecondDifferences.assign(121, Vec3(0.0, 0.002, 0.0));
  std::fill(warp.SecondDifferences.begin() + 50, warp.SecondDifferences.end(),
            Vec3(0.0, -0.003, 0.001));
  warp.IsFixed.assign(121, 0);
  warp.Fixed.assign(121, Vec3::Zero());
  const auto fix = [&](int k, const Vec3& x)
  {
    warp.IsFixed[k] = 1;
    warp.Fixed[k] = x;
  };
  fix(0, Vec3(0, 0, 0));
  fix(50, Vec3(1, 0.2, 0));
  for (int k = 100; k <= 120; ++k)
  {
    fix(k, Vec3(2.0 + 0.02 * (k - 100), 0.0, 0.0));
  }
  const double jump = Vec3(0.0, -0.005, 0.001).norm();
  std::vector<MotionRow> rows(2);
  rows[0].Row = { { 24, 26 }, { -0.5, 0.5 }, Vec3(0.03, 0.0, 0.0) };
  rows[1].Row = { { 73, 75, 77 }, { 0.25, -0.5, 0.25 }, Vec3(0.0, 0.002, 0.0) };
  const std::vector<Vec3> united = UniteFlights({ 50, 100 }, 10, rows, warp);
  for (const MotionRow& row : rows)
  {
    Vec3 value = Vec3::Zero();
    for (std::size_t i = 0; i < row.Row.Frames.size(); ++i)
    {
      value += row.Row.Weights[i] * united[row.Row.Frames[i]];
    }
    EXPECT_LT((value - row.Row.Value).norm(), 1e-12);
  }
  EXPECT_EQ(united[50], Vec3(1, 0.2, 0));
  EXPECT_EQ(united[110], Vec3(2.2, 0, 0));
  const std::vector<Vec3> bends = SecondDifferences(united);
  for (int k = 1; k < 119; ++k)
  {
    EXPECT_LT((bends[k + 1] - bends[k]).norm(), 0.3 * jump) << k;
  }
}
