// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/Warp.h"

#include "Base/Random.h"

#include <gtest/gtest.h>

using namespace waft;

namespace
{

WarpProblem RandomProblem(int count, std::uint64_t seed)
{
  Random random(seed);
  WarpProblem problem;
  for (int k = 0; k < count; ++k)
  {
    problem.SecondDifferences.push_back(0.01 *
                                        Vec3(random.Normal(), random.Normal(), random.Normal()));
  }
  problem.IsFixed.assign(count, 0);
  problem.Fixed.assign(count, Vec3::Zero());
  return problem;
}

void Fix(WarpProblem& problem, int k, const Vec3& value)
{
  problem.IsFixed[k] = 1;
  problem.Fixed[k] = value;
}

double Energy(const WarpProblem& problem, const std::vector<Vec3>& x)
{
  const std::vector<Vec3> bends = SecondDifferences(x);
  double sum = 0.0;
  for (std::size_t k = 1; k + 1 < x.size(); ++k)
  {
    sum += (bends[k] - problem.SecondDifferences[k]).squaredNorm();
  }
  for (const SoftMark& mark : problem.Soft)
  {
    sum += mark.Weight * (x[mark.Frame] - mark.Value).squaredNorm();
  }
  return sum;
}

} // namespace

TEST(Warp, GivesBackAPathWhoseBendsAndEndsItWasGiven)
{
  WarpProblem problem = RandomProblem(120, 3);
  std::vector<Vec3> path{ Vec3(1, 2, 3), Vec3(1.1, 2.0, 3.0) };
  for (int k = 1; k + 1 < 120; ++k)
  {
    path.push_back(2.0 * path[k] - path[k - 1] + problem.SecondDifferences[k]);
  }
  Fix(problem, 0, path.front());
  Fix(problem, 60, path[60]);
  Fix(problem, 119, path.back());
  const std::vector<Vec3> solved = SolveWarp(problem);
  for (int k = 0; k < 120; ++k)
  {
    EXPECT_LT((solved[k] - path[k]).norm(), 1e-9);
  }
  EXPECT_EQ(solved[60], path[60]);
}

TEST(Warp, CorrectionIsASmoothSplineBetweenTheMarks)
{
  WarpProblem problem = RandomProblem(101, 4);
  Fix(problem, 0, Vec3::Zero());
  Fix(problem, 40, Vec3(0.5, -0.2, 0.1));
  Fix(problem, 100, Vec3(1.0, 0.0, 0.3));
  const std::vector<Vec3> bends = SecondDifferences(SolveWarp(problem));
  // Away from the marks the fourth difference of the correction vanishes: a cubic.
  for (int k = 3; k < 98; ++k)
  {
    if (k < 38 || k > 42)
    {
      const Vec3 a = bends[k - 1] - problem.SecondDifferences[k - 1];
      const Vec3 b = bends[k] - problem.SecondDifferences[k];
      const Vec3 c = bends[k + 1] - problem.SecondDifferences[k + 1];
      EXPECT_LT((a - 2.0 * b + c).norm(), 1e-10);
    }
  }
}

TEST(Warp, MeetsRowsAndNoNearbyPathIsBetter)
{
  WarpProblem problem = RandomProblem(80, 5);
  Fix(problem, 0, Vec3(0, 0, 1));
  Fix(problem, 79, Vec3(1, 1, 1));
  problem.Rows.push_back({ { 29, 31 }, { -0.5, 0.5 }, Vec3(0.02, -0.01, 0.0) });
  problem.Rows.push_back({ { 48, 50, 52 }, { 0.25, -0.5, 0.25 }, Vec3(0.0, 0.001, 0.0) });
  problem.Rows.push_back({ { 0, 1, 2 }, { -1.5, 2.0, -0.5 }, Vec3(0.0, 0.03, 0.0) });
  problem.Soft.push_back({ 65, Vec3(1, 0, 2), 0.1 });
  const std::vector<Vec3> x = SolveWarp(problem);
  for (const LinearRow& row : problem.Rows)
  {
    Vec3 value = Vec3::Zero();
    for (std::size_t i = 0; i < row.Frames.size(); ++i)
    {
      value += row.Weights[i] * x[row.Frames[i]];
    }
    EXPECT_LT((value - row.Value).norm(), 1e-12);
  }
  Random random(8);
  const double energy = Energy(problem, x);
  for (int trial = 0; trial < 30; ++trial)
  {
    // A change that keeps every row: away from the frames they touch.
    std::vector<Vec3> other = x;
    const int k = 3 + static_cast<int>(random.Index(25));
    other[k == 29 ? 28 : k] += 1e-3 * random.Direction();
    other[55 + random.Index(20)] += 1e-3 * random.Direction();
    EXPECT_GT(Energy(problem, other), energy);
  }
}

TEST(Warp, SurvivesRowsThatContradictFixedSamples)
{
  WarpProblem problem = RandomProblem(20, 6);
  for (int k = 5; k < 10; ++k)
  {
    Fix(problem, k, Vec3(k, 0, 0));
  }
  problem.Rows.push_back({ { 6, 8 }, { -0.5, 0.5 }, Vec3(9, 9, 9) });
  for (const Vec3& x : SolveWarp(problem))
  {
    EXPECT_TRUE(x.allFinite());
  }
}
