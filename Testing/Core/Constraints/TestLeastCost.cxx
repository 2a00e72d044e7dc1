// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/LeastCost.h"

#include "Base/Random.h"

#include <gtest/gtest.h>

#include <functional>
#include <set>

using namespace waft;

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
