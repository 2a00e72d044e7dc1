// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/Assignment.h"

#include "Base/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

using namespace waft;

namespace
{

double CostOf(const std::vector<double>& costs, std::size_t columns, const std::vector<int>& chosen)
{
  double sum = 0.0;
  for (std::size_t r = 0; r < chosen.size(); ++r)
  {
    sum += chosen[r] < 0 ? 1e3 : costs[r * columns + static_cast<std::size_t>(chosen[r])];
  }
  return sum;
}

MotionObject ObjectAt(int id, const Vec3& position, int classId = -1)
{
  MotionObject object;
  object.ObjectId = id;
  object.Position = position;
  object.ClassId = classId;
  return object;
}

Constraint AnyAt(int row, int target, int frame, const Vec3& value, int group)
{
  Constraint constraint;
  constraint.Row = row;
  constraint.Target = target;
  constraint.Frame = frame;
  constraint.Value = value;
  constraint.Group = group;
  return constraint;
}

} // namespace

TEST(AssignLeastCost, EqualsEveryPermutationTried)
{
  Random random(11);
  for (int trial = 0; trial < 60; ++trial)
  {
    const std::size_t rows = 1 + random.Index(5);
    const std::size_t columns = rows + random.Index(3);
    std::vector<double> costs(rows * columns);
    for (double& cost : costs)
    {
      cost = random.Uniform();
    }
    const std::vector<int> chosen = AssignLeastCost(costs, rows, columns);
    std::vector<int> order(columns);
    std::iota(order.begin(), order.end(), 0);
    double best = 1e300;
    do
    {
      best = std::min(
        best, CostOf(costs, columns, std::vector<int>(order.begin(), order.begin() + long(rows))));
    } while (std::next_permutation(order.begin(), order.end()));
    EXPECT_NEAR(CostOf(costs, columns, chosen), best, 1e-12);
    EXPECT_EQ(std::set<int>(chosen.begin(), chosen.end()).size(), rows);
  }
}

TEST(AssignLeastCost, KeepsForbiddenPairsApartAndAssignsAllThatCanBe)
{
  const double no = std::numeric_limits<double>::infinity();
  // Row 1 may only take column 0, so row 0 has to give it up.
  EXPECT_EQ(AssignLeastCost({ 0.0, 5.0, 1.0, no }, 2, 2), (std::vector<int>{ 1, 0 }));
  // More rows than columns: the dearest row stays without.
  EXPECT_EQ(AssignLeastCost({ 3.0, 1.0, 2.0 }, 3, 1), (std::vector<int>{ -1, 0, -1 }));
  EXPECT_EQ(AssignLeastCost({ no }, 1, 1), (std::vector<int>{ -1 }));
}

TEST(AssignRows, StartsEachKeyframeFromThePlacesOfTheOneBefore)
{
  const std::vector<MotionObject> objects{ ObjectAt(0, Vec3(0, 0, 0)), ObjectAt(1, Vec3(1, 0, 0)) };
  // Listed in the wrong order of time: the second keyframe is decided from the first one's places.
  std::vector<Constraint> rows{ AnyAt(0, 0, 50, Vec3(0, 9, 0), 1),
                                AnyAt(0, 1, 50, Vec3(5, 9, 0), 1),
                                AnyAt(1, 0, 20, Vec3(5, 0, 0), 0),
                                AnyAt(1, 1, 20, Vec3(-5, 0, 0), 0) };
  AssignRows(objects, rows);
  EXPECT_EQ(rows[2].ObjectId, 1);
  EXPECT_EQ(rows[3].ObjectId, 0);
  EXPECT_EQ(rows[0].ObjectId, 0);
  EXPECT_EQ(rows[1].ObjectId, 1);
}

TEST(AssignRows, KeepsClassesNamedObjectsAndTargetsTogether)
{
  const std::vector<MotionObject> objects{ ObjectAt(7, Vec3(0, 0, 0), 1),
                                           ObjectAt(8, Vec3(1, 0, 0), 2),
                                           ObjectAt(9, Vec3(2, 0, 0), 2) };
  std::vector<Constraint> rows{ AnyAt(0, 0, 10, Vec3(0, 0, 0), 3),
                                AnyAt(0, 0, 10, Vec3(0, 0, 1), 3),
                                AnyAt(0, 1, 10, Vec3(1, 0, 0), 3),
                                AnyAt(0, 2, 10, Vec3(2, 0, 0), 3) };
  rows[0].ClassId = 2;
  rows[1].Kind = ConstraintKind::Velocity;
  rows[2].ObjectId = 8; // named, so the open target of class 2 goes to 9
  AssignRows(objects, rows);
  EXPECT_EQ(rows[0].ObjectId, 9);
  EXPECT_EQ(rows[1].ObjectId, 9);
  EXPECT_EQ(rows[2].ObjectId, 8);
  EXPECT_EQ(rows[3].ObjectId, 7);
}

TEST(AssignRows, LeavesTargetsOverThatNobodyCanTake)
{
  const std::vector<MotionObject> objects{ ObjectAt(0, Vec3::Zero()) };
  std::vector<Constraint> rows{ AnyAt(0, 0, 10, Vec3(2, 0, 0), 0),
                                AnyAt(0, 1, 10, Vec3(1, 0, 0), 0) };
  AssignRows(objects, rows);
  EXPECT_EQ(rows[0].ObjectId, -1);
  EXPECT_EQ(rows[1].ObjectId, 0);
}
