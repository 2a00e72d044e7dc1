// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/LeastCost.h"

#include "Base/Random.h"
#include "Constraints/NearestColumns.h"
#include "PlainAssignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>

using namespace waft;
using namespace waft::test;

namespace
{

RankedCost CostOf(const AssignmentProblem& problem, const std::vector<int>& chosen)
{
  RankedCost sum;
  for (std::size_t r = 0; r < chosen.size(); ++r)
  {
    sum = sum + (chosen[r] < 0 ? problem.LeftOut[r] : problem.At(r, std::size_t(chosen[r])));
  }
  return sum;
}

/// The least cost of all choices that there are.
RankedCost TryAll(const AssignmentProblem& problem)
{
  RankedCost best{ 1000000, 0.0 };
  std::vector<int> chosen;
  std::set<int> taken;
  const std::function<void()> extend = [&]()
  {
    if (chosen.size() == problem.Rows())
    {
      const RankedCost cost = CostOf(problem, chosen);
      best = cost < best ? cost : best;
      return;
    }
    for (int c = -1; c < static_cast<int>(problem.Columns); ++c)
    {
      if (c < 0 || (taken.count(c) == 0 && problem.At(chosen.size(), std::size_t(c)).IsAllowed()))
      {
        chosen.push_back(c);
        taken.insert(c);
        extend();
        taken.erase(c);
        chosen.pop_back();
      }
    }
  };
  extend();
  return best;
}

/// The same pairs as a table.
AssignmentProblem TableOf(const ColumnSearch& search)
{
  AssignmentProblem problem(search.Columns(), search.LeftOut());
  for (std::size_t row = 0; row < problem.Rows(); ++row)
  {
    for (std::size_t column = 0; column < problem.Columns; ++column)
    {
      problem.At(row, column) = search.Cost(row, column);
    }
  }
  return problem;
}

using Points = std::vector<Vec3>;

Points RandomPoints(std::size_t count, const Box& box, Random& random)
{
  Points points;
  for (std::size_t i = 0; i < count; ++i)
  {
    points.push_back(random.InBox(box));
  }
  return points;
}

Points LatticePoints(std::size_t count, Random& random)
{
  Points points;
  for (std::size_t i = 0; i < count; ++i)
  {
    points.push_back(Vec3(random.Index(4), random.Index(4), random.Index(3)));
  }
  return points;
}

NearestColumns OneKind(const Points& columns, const Points& rows)
{
  std::vector<NearestColumns::Candidate> candidates;
  for (std::size_t c = 0; c < columns.size(); ++c)
  {
    candidates.push_back({ c, columns[c], 0 });
  }
  std::vector<NearestColumns::Row> seeing;
  for (const Vec3& row : rows)
  {
    seeing.push_back({ 0, row });
  }
  const RankedCost leftOut{ std::int64_t(rows.size()) + 1, 0.0 };
  return NearestColumns(columns.size(), leftOut, { candidates }, seeing);
}

/// Of the cost that the plain way finds, no column twice, and proved by its own bound.
void ExpectLeast(NearestColumns search, bool isUnique)
{
  const AssignmentProblem table = TableOf(search);
  const std::vector<int> plain = PlainAssignment(table).Run();
  const Assignment found = AssignLeastCost(search);
  std::vector<int> taken;
  std::copy_if(found.ColumnOf.begin(), found.ColumnOf.end(), std::back_inserter(taken),
               [](int column) { return column >= 0; });
  std::sort(taken.begin(), taken.end());
  EXPECT_EQ(std::adjacent_find(taken.begin(), taken.end()), taken.end());
  const RankedCost least = CostOf(table, plain);
  const RankedCost cost = CostOf(table, found.ColumnOf);
  const double rounding = 1e-11 * (1.0 + least.Amount);
  EXPECT_EQ(cost.Penalty, least.Penalty);
  EXPECT_NEAR(cost.Amount, least.Amount, rounding);
  EXPECT_EQ(found.Cost.Penalty, least.Penalty);
  EXPECT_NEAR(found.Cost.Amount, least.Amount, rounding);
  EXPECT_EQ(found.Bound.Penalty, least.Penalty);
  EXPECT_NEAR(found.Bound.Amount, least.Amount, rounding);
  if (isUnique)
  {
    EXPECT_EQ(found.ColumnOf, plain);
  }
}

} // namespace

TEST(AssignLeastCost, EqualsEveryChoiceTried)
{
  Random random(11);
  for (int trial = 0; trial < 300; ++trial)
  {
    std::vector<RankedCost> leftOut(1 + random.Index(5));
    for (RankedCost& cost : leftOut)
    {
      cost = { std::int64_t(random.Index(3)), random.Uniform() };
    }
    AssignmentProblem problem(random.Index(6), leftOut);
    for (RankedCost& cost : problem.Costs)
    {
      if (random.Uniform() < 0.7)
      {
        cost = { std::int64_t(random.Index(2)), random.Uniform() };
      }
    }
    const std::vector<int> chosen = AssignLeastCost(problem);
    ASSERT_EQ(chosen.size(), problem.Rows());
    std::set<int> taken;
    for (std::size_t r = 0; r < chosen.size(); ++r)
    {
      if (chosen[r] >= 0)
      {
        EXPECT_TRUE(taken.insert(chosen[r]).second);
        EXPECT_TRUE(problem.At(r, std::size_t(chosen[r])).IsAllowed());
      }
    }
    const RankedCost found = CostOf(problem, chosen);
    const RankedCost best = TryAll(problem);
    EXPECT_EQ(found.Penalty, best.Penalty);
    EXPECT_NEAR(found.Amount, best.Amount, 1e-12);
  }
}

TEST(AssignLeastCost, TakesTheFirstOfEquals)
{
  AssignmentProblem problem(3, { { 9, 0.0 }, { 9, 0.0 } });
  std::fill(problem.Costs.begin(), problem.Costs.end(), RankedCost{ 0, 1.0 });
  EXPECT_EQ(AssignLeastCost(problem), (std::vector<int>{ 0, 1 }));
}

TEST(NearestColumns, EqualsThePlainWayWherePointsAreApart)
{
  Random random(3);
  const Box air;
  const Box ground{ Vec3(-2, -2, 0), Vec3(2, 2, 0) };
  const Box line{ Vec3(9, 1, 0), Vec3(9, 1, 4) };
  for (const Box& targets : { air, ground, line })
  {
    for (const auto& [columns, rows] :
         { std::pair(1, 1), std::pair(60, 60), std::pair(300, 300), std::pair(300, 200) })
    {
      ExpectLeast(OneKind(RandomPoints(columns, air, random), RandomPoints(rows, targets, random)),
                  true);
    }
  }
}

TEST(NearestColumns, CostsTheSameAsThePlainWayWhereManyAreEqual)
{
  Random random(4);
  const Points together(120, Vec3(1, 2, 3));
  for (int trial = 0; trial < 20; ++trial)
  {
    ExpectLeast(OneKind(LatticePoints(100, random), LatticePoints(100, random)), false);
    ExpectLeast(OneKind(LatticePoints(100, random), LatticePoints(70, random)), false);
  }
  ExpectLeast(OneKind(together, LatticePoints(100, random)), false);
  ExpectLeast(OneKind(LatticePoints(100, random), together), false);
  ExpectLeast(OneKind(together, together), false);
}

TEST(NearestColumns, LeavesOutThoseWhoCostTheMost)
{
  Random random(5);
  const Box air;
  ExpectLeast(OneKind(RandomPoints(80, air, random), RandomPoints(200, air, random)), false);
  ExpectLeast(OneKind(LatticePoints(50, random), LatticePoints(90, random)), false);
  ExpectLeast(OneKind({}, RandomPoints(5, air, random)), true);
  ExpectLeast(OneKind(RandomPoints(5, air, random), {}), true);
}

TEST(NearestColumns, EqualsThePlainWayWithKindsAndPenalties)
{
  Random random(6);
  const Box air;
  for (int trial = 0; trial < 100; ++trial)
  {
    const std::size_t columns = 1 + random.Index(40);
    std::vector<std::vector<NearestColumns::Candidate>> kinds(1 + random.Index(3));
    for (auto& candidates : kinds)
    {
      const double fraction = random.Uniform();
      for (std::size_t c = 0; c < columns; ++c)
      {
        if (random.Uniform() < fraction)
        {
          candidates.push_back({ c, random.InBox(air), std::int64_t(random.Index(2)) });
        }
      }
    }
    std::vector<NearestColumns::Row> rows(1 + random.Index(60));
    for (NearestColumns::Row& row : rows)
    {
      row = { random.Index(std::uint32_t(kinds.size())), random.InBox(air) };
    }
    const RankedCost leftOut{ std::int64_t(rows.size()) + 1, 0.0 };
    ExpectLeast(NearestColumns(columns, leftOut, kinds, rows), false);
  }
}

TEST(NearestColumns, IsProvedToBeTheLeastOfTenThousand)
{
  Random random(7);
  NearestColumns search =
    OneKind(RandomPoints(10000, Box(), random), RandomPoints(10000, Box(), random));
  const Assignment found = AssignLeastCost(search);
  EXPECT_EQ(found.Cost.Penalty, 0);
  EXPECT_NEAR(found.Cost.Amount, found.Bound.Amount, 1e-9 * found.Cost.Amount);
}
