// SPDX-License-Identifier: BSD-3-Clause
#include "ConstraintFixture.h"

#include "Base/Random.h"
#include "Constraints/LinearRows.h"
#include "Constraints/Rest.h"

#include <Eigen/QR>

#include <gtest/gtest.h>

#include <limits>

using namespace waft;
using namespace waft::testing;

TEST(ConstraintCheck, RowsThatAnEarlierStageFoundUnmetStaySo)
{
  Fixture f;
  f.Add(Kind::Position, 10, Vec3(0, 1, 2));
  f.Add(Kind::Position, 20, Vec3(0, 0, 2)).Status = ConstraintStatus::Unreachable;
  f.Add(Kind::Position, 20, Vec3(0, 0.5, 2)); // would contradict the row before, did that bind
  EXPECT_EQ(f.Statuses(), (Statuses{ Met, ConstraintStatus::Unreachable, Met }));
}

TEST(ConstraintCheck, PlacesThatCannotBeAreInfeasible)
{
  Fixture f;
  f.Add(Kind::Position, 10, Vec3(1, 0, 0.7));      // in the box
  f.Add(Kind::Position, 11, Vec3(1, 0, 0.7), 0.2); // its whole ball too
  f.Add(Kind::Position, 12, Vec3(1, 0, 0.7), 0.4); // the ball reaches out
  f.Add(Kind::Position, 13, Vec3(0, 0, 4.5));      // above the top
  f.Add(Kind::Position, 14, Vec3(0, 0, 4.5), 0.6);
  f.Add(Kind::Position, 15, Vec3(0, 0, -0.1));        // below the ground
  f.Add(Kind::Position, 16, Vec3(-1.2, -0.2, 0.55));  // in the lift, before it rises
  f.Add(Kind::Position, 90, Vec3(-1.2, -0.2, 0.55));  // after
  f.Add(Kind::Rest, 50, Vec3(1, 0, 0.5));             // inside the box: lies on its top
  f.Add(Kind::Position, 52, Vec3(1, 0, 0.9999), 0.1); // at rest on it by then
  f.Rows[8].Until = 52;
  f.Add(Kind::Rest, 60, Vec3(9, 9, 1));                  // nothing below
  f.Add(Kind::Rest, 45, Vec3(-1.2, -0.2, 1)).Until = 70; // it goes along with the lift
  f.Rows.back().ObjectId = 1;
  f.Add(Kind::Position, 100, Vec3(0, 0, 1));             // no such frame
  f.Add(Kind::Position, 20, Vec3(0, 0, 1)).ObjectId = 7; // no such object
  f.Add(Kind::Velocity, 21, Vec3(0, 0, std::numeric_limits<double>::quiet_NaN()));
  const Statuses expected{ Infeasible, Infeasible, Met,        Infeasible, Met,
                           Infeasible, Infeasible, Met,        Met,        Met,
                           Infeasible, Met,        Infeasible, Infeasible, Infeasible };
  EXPECT_EQ(f.Statuses(), expected);
  EXPECT_NE(f.Judged()[0].Message.find("0.3 m inside obstacle 1"), std::string::npos)
    << f.Judged()[0].Message;
  EXPECT_NE(f.Judged()[3].Message.find("0.5 m outside the volume"), std::string::npos)
    << f.Judged()[3].Message;
}

TEST(ConstraintCheck, WhatGoesAlongWithAnObstacleHasToStayInside)
{
  Fixture f; // the lift, 2, rises by half a metre from frame 50 on
  f.Add(Kind::Rest, 45, Vec3(-1.2, -0.2, 1)).On = 2;
  f.Rows[0].Until = 90;
  f.Add(Kind::Rest, 45, Vec3(-1.2, -0.2, 1)).On = 1;
  f.Add(Kind::Position, 30, Vec3(-1.2, -0.2, 3.8)).On = 2;
  f.Rows[2].Hold = 60;
  f.Rows[2].Until = 90;
  f.Add(Kind::Position, 30, Vec3(-1.2, -0.2, 3.8)).On = 2;
  f.Add(Kind::Position, 30, Vec3(1, 0, 1.4)).On = 9;
  for (std::size_t i = 0; i < f.Rows.size(); ++i)
  {
    f.Objects.resize(f.Rows.size(), f.Objects[0]);
    f.Objects[i].ObjectId = f.Rows[i].ObjectId = static_cast<int>(i);
  }
  EXPECT_EQ(f.Statuses(), (Statuses{ Met, Infeasible, Infeasible, Met, Infeasible }));
  const std::vector<ReportRow> report = f.Judged();
  const auto says = [&](std::size_t i, const char* part)
  { EXPECT_NE(report[i].Message.find(part), std::string::npos) << report[i].Message; };
  says(1, "is of obstacle 2, expected obstacle 1, which it is to lie on");
  says(2, "obstacle 2 carries it to (-1.2, -0.2, 4.01) at frame 71, outside the volume");
  says(4, "there is no obstacle 9 that it is on");
}

TEST(ConstraintCheck, BallsAndPointsOfOneFrameMustMeet)
{
  Fixture f;
  f.Add(Kind::Position, 10, Vec3(0, 1, 2), 0.1);
  f.Add(Kind::Position, 10, Vec3(0, 1.3, 2), 0.21);
  f.Add(Kind::Position, 10, Vec3(0, 1.3, 2), 0.19);
  f.Add(Kind::Position, 0, Vec3(0, 0, 2.1));
  f.Add(Kind::Position, 0, Vec3(0, 0, 2.1), 0.11);
  f.Add(Kind::Velocity, 30, Vec3(1, 0, 0));
  f.Add(Kind::Velocity, 30, Vec3(1.5, 0, 0), 0.4);
  f.Add(Kind::Velocity, 30, Vec3(1, 0, 0));
  f.Add(Kind::Position, 10, Vec3(0, 9, 2)).ObjectId = 1; // outside, and another object's
  EXPECT_EQ(f.Statuses(),
            (Statuses{ Met, Met, Conflict, Conflict, Met, Met, Conflict, Met, Infeasible }));
  EXPECT_NE(f.Judged()[2].Message.find(
              "row 2 target 0 (position at frame 10) contradicts row 0 target 0 (position at "
              "frame 10): 0.3 m apart, expected at most 0.29 m"),
            std::string::npos)
    << f.Judged()[2].Message;
  EXPECT_NE(f.Judged()[3].Message.find("the object's start"), std::string::npos);
}

TEST(ConstraintCheck, RestHoldsItsPlaceAndItsStillness)
{
  Fixture f;
  f.Add(Kind::Rest, 40, Vec3(-0.5, 1, 1)).Until = 60;
  f.Add(Kind::Position, 50, Vec3(-0.5, 1, 0.01)); // the place itself
  f.Add(Kind::Position, 55, Vec3(-0.5, 1, 0.2));
  f.Add(Kind::Velocity, 50, Vec3(0, 0, 0.1));
  f.Add(Kind::Velocity, 51, Vec3::Zero());
  f.Add(Kind::Velocity, 40, Vec3(0, 0, -0.5)); // still arriving
  f.Add(Kind::Velocity, 60, Vec3(0, 0, 0.5));  // lifting off
  f.Add(Kind::Rest, 60, Vec3(-0.4, 1, 1)).Until = 70;
  f.Add(Kind::Rest, 61, Vec3(-0.4, 1, 1)).Until = 70;
  EXPECT_EQ(f.Statuses(),
            (Statuses{ Met, Met, Conflict, Conflict, Met, Met, Met, Conflict, Conflict }));
  // The last one would throw the object from one place to the other in a frame: with the velocity
  // of row 6 that cannot be, without it, it can.
  f.Rows.erase(f.Rows.begin() + 6);
  EXPECT_EQ(f.Statuses().back(), Met);
}

TEST(ConstraintCheck, VelocitiesAndAccelerationsAgainstAdjacentPlaces)
{
  Fixture f;
  f.Add(Kind::Position, 20, Vec3(0, 0, 2));
  f.Add(Kind::Position, 22, Vec3(0.2, 0, 2));
  f.Add(Kind::Velocity, 21, Vec3(1, 0, 0)); // 0.2 m in two frames of 0.1 s
  f.Add(Kind::Velocity, 21, Vec3(1, 0.1, 0));
  f.Add(Kind::Velocity, 23, Vec3(0, 1, 0));
  f.Add(Kind::Position, 24, Vec3(0.2, 0.2, 2)); // what the velocity says
  f.Add(Kind::Position, 26, Vec3(0.2, 0.5, 2), 0.05);
  f.Add(Kind::Velocity, 25, Vec3(0, 1.2, 0)); // 0.24 m: not within the ball of row 6
  f.Add(Kind::Velocity, 25, Vec3(0, 1.2, 0), 0.1);
  f.Add(Kind::Acceleration, 22, Vec3(-5, 5, 0)); // ((0,1) - (1,0)) / 0.2 s
  f.Add(Kind::Acceleration, 22, Vec3(-5, 5, 1));
  f.Add(Kind::Acceleration, 22, Vec3(-5, 5, 1), 1.5);
  EXPECT_EQ(f.Statuses(), (Statuses{ Met, Met, Met, Conflict, Met, Met, Met, Conflict, Met, Met,
                                     Conflict, Met }));
  // Through a chain: velocities at 41 and 43 and places at 40 and 44 leave one equation too many.
  Fixture chain;
  chain.Add(Kind::Position, 40, Vec3(0, 0, 2));
  chain.Add(Kind::Velocity, 41, Vec3(1, 0, 0));
  chain.Add(Kind::Velocity, 43, Vec3(1, 0, 0));
  chain.Add(Kind::Position, 44, Vec3(0.5, 0, 2));
  EXPECT_EQ(chain.Statuses(), (Statuses{ Met, Met, Met, Conflict }));
  const std::string message = chain.Judged()[3].Message;
  for (const char* part : { "row 0", "row 1", "row 2", "row 3" })
  {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }
  chain.Rows[3].Value.x() = 0.4;
  EXPECT_EQ(chain.Statuses(), (Statuses{ Met, Met, Met, Met }));
}

TEST(ConstraintCheck, StencilsAreTheCentralDifferences)
{
  const Timeline time{ 9, 12.0 };
  Random random(8);
  std::vector<Vec3> x(9);
  for (Vec3& p : x)
  {
    p = random.Direction();
  }
  const auto v = CentralDifferences(x, time.Step());
  const auto a = CentralDifferences(v, time.Step());
  for (int f = 0; f < 9; ++f)
  {
    Vec3 sumV = Vec3::Zero(), sumA = Vec3::Zero();
    for (const auto& [k, c] : DerivativeStencil(1, f, time))
    {
      sumV += c * x[k];
    }
    for (const auto& [k, c] : DerivativeStencil(2, f, time))
    {
      sumA += c * x[k];
    }
    EXPECT_LT((sumV - v[f]).norm(), 1e-12);
    EXPECT_LT((sumA - a[f]).norm(), 1e-11);
  }
}

TEST(ConstraintCheck, OrientationsOfOneFrameMustAgree)
{
  Fixture f;
  f.Add(Kind::Orientation, 30, Vec3::Zero());
  f.Add(Kind::Orientation, 30, Vec3::Zero(), 0.2).Orientation =
    Quat(Eigen::AngleAxisd(0.3, Vec3::UnitX()));
  f.Add(Kind::Orientation, 30, Vec3::Zero(), 0.2).Orientation =
    Quat(-Quat(Eigen::AngleAxisd(0.1, Vec3::UnitX())).coeffs()); // the same turn, other sign
  EXPECT_EQ(f.Statuses(), (Statuses{ Met, Conflict, Met }));
}

TEST(ConstraintCheck, LinesAreSortedAndTargetsWithoutObjectAreNamed)
{
  Fixture f;
  for (int target = 4; target >= 0; --target)
  {
    Constraint& row = f.Add(Kind::Position, 50, Vec3(0.3 * target - 0.6, 1, 1));
    row.ObjectId = -1;
    row.Row = 3;
    row.Target = target;
    row.Group = 0;
    row.ClassId = target < 2 ? 1 : -1; // one object of class 1, two of class 0
    Constraint still = row;
    still.Kind = Kind::Velocity;
    f.Rows.push_back(still);
  }
  std::reverse(f.Rows.begin(), f.Rows.end());
  f.Add(Kind::Position, 60, Vec3(0, 1, 1)).Row = 1;
  const auto report = f.Judged();
  ASSERT_EQ(report.size(), 6u);
  EXPECT_EQ(report[0].Row, 1);
  for (int target = 0; target < 5; ++target)
  {
    EXPECT_EQ(report[target + 1].Target, target);
    const bool fails = target == 1 || target == 4;
    EXPECT_EQ(report[target + 1].Status, fails ? Infeasible : Met) << target;
    EXPECT_EQ(IsBinding(f.Rows[2 * target], report), !fails);
  }
}

TEST(ConstraintCheck, TargetsAreKeptOrRefusedWhole)
{
  Fixture f;
  f.Add(Kind::Position, 30, Vec3(0, 0, 2));
  const Constraint place = f.Add(Kind::Position, 32, Vec3(0.5, 0, 2));
  Constraint speed = place;
  speed.Kind = Kind::Velocity;
  speed.Frame = 31;
  f.Rows.push_back(speed); // contradicts the two places
  Constraint later = place;
  later.Row = 2;
  later.Value.x() = 0.7; // free, as row 1 is refused
  f.Rows.push_back(later);
  EXPECT_EQ(f.Statuses(), (Statuses{ Met, Conflict, Met }));
}

TEST(ConstraintCheck, ALineMayContradictItself)
{
  Fixture f;
  f.Add(Kind::Position, 30, Vec3(0, 0, 2));
  f.Add(Kind::Position, 32, Vec3(0.5, 0, 2)).Row = 0;
  f.Add(Kind::Velocity, 31, Vec3(0, 0, 0)).Row = 0;
  f.Add(Kind::Position, 30, Vec3(0, 0.1, 2)).Row = 1; // free again
  EXPECT_EQ(f.Statuses(), (Statuses{ Conflict, Met }));
  EXPECT_NE(f.Judged()[0].Message.find("contradicts itself"), std::string::npos);
}

TEST(ConstraintCheck, AChainOfThousandsOfVelocitiesIsFollowedToItsEnds)
{
  Fixture f;
  constexpr int count = 8000;
  f.Scene.Time.NumberOfFrames = count + 2;
  for (int frame = 1; frame <= count; ++frame)
  {
    f.Add(Kind::Velocity, frame, Vec3(0, 0.001, 0));
  }
  f.Add(Kind::Position, count, Vec3(0, 0, 2)); // 0.8 m from where the chain from the start leads
  f.Add(Kind::Position, count + 1, Vec3(0, 0, 2));
  const std::vector<ReportRow> report = f.Judged();
  for (int row = 0; row < count; ++row)
  {
    ASSERT_EQ(report[row].Status, Met) << row;
  }
  EXPECT_EQ(report[count].Status, Conflict);
  EXPECT_NE(report[count].Message.find("contradicts the object's start, row 0 target 0"),
            std::string::npos)
    << report[count].Message;
  EXPECT_NE(report[count].Message.find(" and 3997 more: no positions satisfy all of them, 0.8 m"),
            std::string::npos)
    << report[count].Message;
  EXPECT_EQ(report[count + 1].Status, Met) << "nothing says where it is at odd frames";
}

TEST(ConstraintCheck, LongRestsOfManyAreComparedWhereRowsMeet)
{
  Fixture f;
  f.Scene.Time.NumberOfFrames = 1000000;
  f.Add(Kind::Rest, 200, Vec3(0, 1, 2)).Until = 999999;
  f.Add(Kind::Rest, 300, Vec3(0, 1, 2)).Until = 999999;
  f.Add(Kind::Position, 500000, Vec3(0, 1, 0.01));
  f.Add(Kind::Position, 600000, Vec3(0, 1, 0.5));
  f.Add(Kind::Velocity, 700000, Vec3(0, 0, 0.2));
  f.Add(Kind::Rest, 800000, Vec3(0, -1, 2)).Until = 900000;
  f.Add(Kind::Velocity, 100, Vec3(0, 0, 0.2));
  EXPECT_EQ(f.Statuses(), (Statuses{ Met, Met, Met, Conflict, Conflict, Conflict, Met }));
  EXPECT_NE(f.Judged()[5].Message.find("rest at frame 800000"), std::string::npos);
}

TEST(ConstraintCheck, AgreesWithDenseLinearAlgebraOnExactRows)
{
  int conflicts = 0;
  for (int seed = 0; seed < 200; ++seed)
  {
    Random random(static_cast<std::uint64_t>(seed));
    Fixture f;
    constexpr int frames = 10;
    f.Scene.Time.NumberOfFrames = frames;
    std::vector<Vec3> x{ f.Objects[0].Position };
    for (int k = 1; k < frames; ++k)
    {
      x.push_back(x.back() + 0.1 * random.Direction());
    }
    const std::vector<Vec3> v = CentralDifferences(x, f.Scene.Time.Step());
    const std::vector<Vec3> a = CentralDifferences(v, f.Scene.Time.Step());
    Eigen::MatrixXd kept = Eigen::MatrixXd::Zero(1, frames + 3); // coefficients and values
    kept(0, 0) = 1.0;
    kept.row(0).tail<3>() = x[0].transpose();
    Statuses expected;
    for (int n = 0; n < 16; ++n)
    {
      const auto kind = static_cast<Kind>(random.Index(3));
      const int frame = static_cast<int>(random.Index(frames));
      Vec3 value = kind == Kind::Position ? x[frame] : kind == Kind::Velocity ? v[frame] : a[frame];
      if (random.Uniform() < 0.2)
      {
        value += 0.01 * random.Direction();
      }
      f.Add(kind, frame, value);
      Eigen::MatrixXd more = Eigen::MatrixXd::Zero(kept.rows() + 1, frames + 3);
      more.topRows(kept.rows()) = kept;
      double largest = 0.0;
      for (const auto& [k, c] : DerivativeStencil(TraitsOf(kind).Derivative, frame, f.Scene.Time))
      {
        more(kept.rows(), k) = c;
        largest = std::max(largest, std::abs(c));
      }
      more.row(kept.rows()).tail<3>() = value.transpose();
      more.row(kept.rows()) /= largest;
      const Eigen::MatrixXd left = more.leftCols(frames);
      const Eigen::MatrixXd right = more.rightCols(3);
      const Eigen::MatrixXd solved = left.completeOrthogonalDecomposition().solve(right);
      const bool isConsistent = (left * solved - right).norm() < 1e-7;
      expected.push_back(isConsistent ? Met : Conflict);
      kept = isConsistent ? more : kept;
      conflicts += !isConsistent;
    }
    EXPECT_EQ(f.Statuses(), expected) << seed;
  }
  EXPECT_GT(conflicts, 200);
}
