// SPDX-License-Identifier: BSD-3-Clause
// Poses that are asked for at a frame: met, smoothly, or named.
#include "Base/Random.h"
#include "Refining.h"

using namespace waft;
using namespace waft::fixtures;

TEST(OrientationRows, OrientationRowsAreMetAndTheMotionStaysSmooth)
{
  RotationInput input = OneObject(CurledLeaf(), SwayingPath(180));
  Random random(9);
  for (const int frame : { 0, 60, 110, 179 })
  {
    const Vec3 axis = random.Direction();
    input.Constraints.push_back(
      OrientationRow(frame, ExpMap(random.Uniform(0.5, 3.0) * axis), frame == 110 ? 0.2 : 0.0));
  }
  const RotationOutput output = Refine(input);
  const std::vector<Quat>& q = output.Poses[0].Orientations;
  for (const Constraint& key : input.Constraints)
  {
    EXPECT_LE(Angle(q[key.Frame], key.Orientation), key.Radius + 1e-9);
  }
  ASSERT_EQ(output.Report.size(), 4u);
  for (const ReportRow& row : output.Report)
  {
    EXPECT_EQ(row.Status, ConstraintStatus::Met) << row.Message;
  }
  // Natural between: no faster and no jerkier than the same leaf turns without rows, but for half a
  // turn within the shortest time between two rows.
  RotationInput free = input;
  free.Constraints.clear();
  const std::vector<Vec3> own = Refine(free).Poses[0].AngularVelocities;
  const std::vector<Vec3>& rates = output.Poses[0].AngularVelocities;
  const auto fastest = [](const std::vector<Vec3>& list)
  {
    double most = 0.0;
    for (const Vec3& rate : list)
    {
      most = std::max(most, rate.norm());
    }
    return most;
  };
  const double added = 1.875 * std::acos(-1.0) * 30.0 / 50.0; // the ease's greatest slope
  EXPECT_LT(fastest(rates), 1.5 * fastest(own) + added);
  for (std::size_t k = 1; k < q.size(); ++k)
  {
    EXPECT_GT(q[k].dot(q[k - 1]), 0.0) << k;
    const Vec3 step = LogMap(q[k] * q[k - 1].conjugate()) * 30.0;
    EXPECT_LT((step - 0.5 * (rates[k] + rates[k - 1])).norm(), 0.25 * (fastest(own) + added)) << k;
  }
}

TEST(OrientationRows, RowsThatNoTurningRateCanMeetAreNamed)
{
  RotationInput input = OneObject(CurledLeaf(), SwayingPath(60));
  for (const int frame : { 30, 31, 50 })
  {
    input.Constraints.push_back(
      OrientationRow(frame, frame == 31 ? Quat(0.0, 1.0, 0.0, 0.0) : Quat::Identity()));
  }
  const RotationOutput output = Refine(input);
  ASSERT_EQ(output.Report.size(), 3u);
  EXPECT_EQ(output.Report[0].Status, ConstraintStatus::Met);
  EXPECT_EQ(output.Report[1].Status, ConstraintStatus::Unreachable);
  EXPECT_EQ(output.Report[2].Status, ConstraintStatus::Met);
  EXPECT_NEAR(output.Report[1].Residual, std::acos(-1.0) - 60.0 / 30.0, 1e-9);
  EXPECT_NE(output.Report[1].Message.find("orientation at frame 31: missed by"), std::string::npos);
  EXPECT_NE(output.Report[1].Message.find("rad/s since frame 30, more than 60"), std::string::npos);
  ASSERT_EQ(output.Warnings.size(), 2u); // and that it is more than frames show
  EXPECT_EQ(output.Warnings[1], "object 0: " + output.Report[1].Message);
  RotationOptions faster;
  faster.TurningRate = 100.0;
  EXPECT_EQ(Refine(input, faster).Report[1].Status, ConstraintStatus::Met);
}

TEST(OrientationRows, TwoConstraintsAtOneFrameAreNamed)
{
  RotationInput input = OneObject(CurledLeaf(), SwayingPath(60));
  for (const double angle : { 0.3, 1.0 })
  {
    input.Constraints.push_back(OrientationRow(30, ExpMap(Vec3(angle, 0.0, 0.0))));
    input.Constraints.back().Target = static_cast<int>(input.Constraints.size()) - 1;
  }
  const RotationOutput output = Refine(input);
  ASSERT_EQ(output.Report.size(), 2u);
  EXPECT_EQ(output.Report[0].Status, ConstraintStatus::Met);
  EXPECT_EQ(output.Report[1].Status, ConstraintStatus::Conflict);
  EXPECT_NEAR(output.Report[1].Residual, 0.7, 1e-9);
  EXPECT_EQ(output.Warnings.size(), 1u);
}

TEST(OrientationRows, RowsThatAnEarlierStageGaveUpAreMeasuredAndNotReportedAgain)
{
  RotationInput input = OneObject(CurledLeaf(), SwayingPath(60));
  input.Constraints = { OrientationRow(30, Quat(0.0, 0.0, 1.0, 0.0)) };
  input.Constraints[0].Status = ConstraintStatus::Conflict;
  const RotationOutput output = Refine(input);
  ASSERT_EQ(output.Report.size(), 1u);
  EXPECT_EQ(output.Report[0].Status, ConstraintStatus::Conflict);
  EXPECT_GT(output.Report[0].Residual, 0.0);
  EXPECT_TRUE(output.Warnings.empty());
}
