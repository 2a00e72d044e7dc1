// SPDX-License-Identifier: BSD-3-Clause
// Leaves face where a mark asks them to.
#include "Refining.h"

using namespace waft;
using namespace waft::fixtures;

namespace
{
constexpr int Leaves = 40;
constexpr int MarkFrame = 60;
constexpr int FramesFlown = 120;
const Vec3 ToTheReader = Vec3(0.0, -1.0, 0.0);

Constraint FacingRow(int object, const std::vector<Vec3>& path, double tolerance = 0.35)
{
  Constraint row;
  row.ObjectId = object;
  row.Kind = ConstraintKind::Position;
  row.Frame = MarkFrame;
  row.Row = object;
  row.Value = path[MarkFrame];
  row.Facing = ToTheReader;
  row.FacingTolerance = tolerance;
  return row;
}

RotationInput SwayingLeaves()
{
  RotationInput input = OneObject(CurledLeaf(), SwayingPath(FramesFlown));
  input.Objects[0].OrientationGiven = 0;
  for (int i = 1; i < Leaves; ++i)
  {
    input.Objects.push_back(input.Objects[0]);
    input.Objects[i].ObjectId = i;
    input.Tracks.push_back(input.Tracks[0]);
    input.Tracks[i].ObjectId = i;
    input.Tracks[i].Positions = SwayingPath(FramesFlown, 0.3 * i);
  }
  return input;
}

double Off(const RotationOutput& output, int object, int frame)
{
  const Vec3 axis = output.Poses[object].Orientations[frame] * Vec3::UnitZ();
  return std::acos(std::clamp(axis.dot(ToTheReader), -1.0, 1.0));
}

/// rad/s^2, of all bodies in some frames, in order.
std::vector<double> Accelerations(const RotationOutput& output, int first, int last)
{
  std::vector<double> found;
  for (const PoseTrack& poses : output.Poses)
  {
    const auto rate = [&](int k)
    { return Vec3(30.0 * LogMap(poses.Orientations[k + 1] * poses.Orientations[k].conjugate())); };
    for (int k = first; k <= last; ++k)
    {
      found.push_back(30.0 * (rate(k) - rate(k - 1)).norm());
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}
} // namespace

TEST(Facing, BodiesFaceTheReaderInTimeAndFlyAsTheyDidBefore)
{
  RotationInput input = SwayingLeaves();
  const RotationOutput free = Refine(input);
  for (int i = 0; i < Leaves; ++i)
  {
    input.Constraints.push_back(FacingRow(i, input.Tracks[i].Positions));
  }
  const RotationOutput output = Refine(input);
  EXPECT_TRUE(output.Warnings.empty());
  ASSERT_EQ(output.Report.size(), static_cast<std::size_t>(Leaves));
  int away = 0;
  for (int i = 0; i < Leaves; ++i)
  {
    away += Off(free, i, MarkFrame) > 0.35 ? 1 : 0;
    EXPECT_LE(Off(output, i, MarkFrame), 0.35);
    EXPECT_EQ(output.Report[i].Status, ConstraintStatus::Met);
    for (int k = 0; k < MarkFrame - 12; ++k)
    {
      EXPECT_EQ(output.Poses[i].Orientations[k].coeffs(), free.Poses[i].Orientations[k].coeffs());
    }
  }
  EXPECT_GT(away, Leaves / 2); // or nothing was asked
  const std::vector<double> there = Accelerations(output, MarkFrame - 12, MarkFrame + 2);
  const std::vector<double> flight = Accelerations(free, 10, FramesFlown - 3);
  EXPECT_LT(there.back(), 1.5 * flight[flight.size() * 99 / 100]);
}

TEST(Facing, WhatContradictsItIsNamed)
{
  RotationInput input = OneObject(CurledLeaf(), SwayingPath(FramesFlown));
  input.Constraints = { FacingRow(0, input.Tracks[0].Positions),
                        OrientationRow(MarkFrame, ExpMap(Vec3(0.2, 0.0, 0.0))) };
  input.Constraints[1].Row = 7;
  const RotationOutput output = Refine(input);
  EXPECT_LT(Angle(output.Poses[0].Orientations[MarkFrame], input.Constraints[1].Orientation), 1e-9);
  const auto line =
    std::find_if(output.Report.begin(), output.Report.end(),
                 [](const ReportRow& own) { return own.Kind == ConstraintKind::Position; });
  ASSERT_NE(line, output.Report.end());
  EXPECT_EQ(line->Status, ConstraintStatus::Conflict);
  EXPECT_NE(line->Message.find("orientation of row 7"), std::string::npos) << line->Message;
  ASSERT_EQ(output.Warnings.size(), 1u);
  EXPECT_NE(output.Warnings[0].find("object 0: row 0: it faces"), std::string::npos);
}

TEST(Facing, ATurnWithinTheConeIsNone)
{
  RotationInput input = OneObject(CurledLeaf(), SwayingPath(FramesFlown));
  const RotationOutput free = Refine(input);
  input.Constraints = { FacingRow(0, input.Tracks[0].Positions, 3.1) };
  const RotationOutput output = Refine(input);
  EXPECT_LT(Angle(output.Poses[0].Orientations[MarkFrame], free.Poses[0].Orientations[MarkFrame]),
            1e-12);
}
