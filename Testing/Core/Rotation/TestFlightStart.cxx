// SPDX-License-Identifier: BSD-3-Clause
// How bodies begin, where a pose is given and where none is.
#include "Refining.h"

using namespace waft;
using namespace waft::fixtures;

namespace
{
constexpr int Bodies = 60;

/// Leaves that fall straight down side by side, with no pose given.
RotationInput FallingLeaves(int frames)
{
  RotationInput input =
    OneObject(CurledLeaf(), StraightPath(Vec3(0.0, 0.0, 9.0), Vec3(0.0, 0.0, -0.8), frames));
  input.Objects[0].OrientationGiven = 0;
  for (int i = 1; i < Bodies; ++i)
  {
    input.Objects.push_back(input.Objects[0]);
    input.Objects[i].ObjectId = i;
    input.Tracks.push_back(input.Tracks[0]);
    input.Tracks[i].ObjectId = i;
  }
  return input;
}

/// Over all bodies and ten frames: the mean angle of the body's axis with the vertical [rad], and
/// the mean angular speed [rad/s].
std::pair<double, double> Flying(const RotationOutput& output, int first)
{
  double tilt = 0.0;
  double speed = 0.0;
  for (const PoseTrack& poses : output.Poses)
  {
    for (int k = first; k < first + 10; ++k)
    {
      const double up = std::abs((poses.Orientations[k] * Vec3::UnitZ()).z());
      tilt += std::acos(std::min(1.0, up)) / (10.0 * Bodies);
      speed += poses.AngularVelocities[k].norm() / (10.0 * Bodies);
    }
  }
  return { tilt, speed };
}
} // namespace

TEST(FlightStart, WhereNoPoseIsGivenTheFirstFramesAreLikeAnyOthers)
{
  RotationOptions options;
  options.RasterSize = 32;
  const RotationOutput output = Refine(FallingLeaves(120), options);
  const auto [tilt, speed] = Flying(output, 0);
  const auto [laterTilt, laterSpeed] = Flying(output, 110);
  EXPECT_GT(tilt, 0.1);
  EXPECT_NEAR(tilt / laterTilt, 1.0, 0.25);
  EXPECT_NEAR(speed / laterSpeed, 1.0, 0.25);
  // Headings: none in step with another.
  Vec3 mean = Vec3::Zero();
  for (const PoseTrack& poses : output.Poses)
  {
    Vec3 heading = poses.Orientations[0] * Vec3::UnitX();
    heading.z() = 0.0;
    mean += heading.normalized() / Bodies;
  }
  EXPECT_LT(mean.norm(), 0.35); // three standard deviations
}

TEST(FlightStart, IsAnotherByTheSeedAndTheSameByTheSameOne)
{
  const RotationInput input = FallingLeaves(3);
  RotationOptions options;
  options.RasterSize = 32;
  const RotationOutput first = Refine(input, options);
  const RotationOutput again = Refine(input, options, 2);
  options.Seed = 2;
  const RotationOutput other = Refine(input, options);
  for (int i = 0; i < Bodies; ++i)
  {
    EXPECT_EQ(first.Poses[i].Orientations[0].coeffs(), again.Poses[i].Orientations[0].coeffs());
    EXPECT_GT(Angle(first.Poses[i].Orientations[0], other.Poses[i].Orientations[0]), 1e-3);
  }
}

TEST(FlightStart, WhatIsGivenIsKept)
{
  RotationInput input = OneObject(CurledLeaf(), SwayingPath(3));
  input.Objects[0].Orientation = ExpMap(Vec3(0.3, -0.2, 1.0));
  input.Objects[0].AngularVelocity = Vec3(1.0, 2.0, 3.0);
  RotationOutput output = Refine(input);
  EXPECT_LT(Angle(output.Poses[0].Orientations[0], input.Objects[0].Orientation), 1e-12);
  EXPECT_LT((output.Poses[0].AngularVelocities[0] - Vec3(1.0, 2.0, 3.0)).norm(), 1e-12);
  // A spin alone is kept, too, and so is a row of the first frame.
  input.Objects[0].OrientationGiven = 0;
  input.Constraints = { OrientationRow(0, ExpMap(Vec3(0.0, 1.0, 0.0))) };
  output = Refine(input);
  EXPECT_LT((output.Poses[0].AngularVelocities[0] - Vec3(1.0, 2.0, 3.0)).norm(), 1e-12);
  EXPECT_LT(Angle(output.Poses[0].Orientations[0], input.Constraints[0].Orientation), 1e-9);
}

TEST(FlightStart, KeepsToTheLimitOfTurning)
{
  RotationInput input =
    OneObject(Sheet(0.1, 0.012), StraightPath(Vec3(0.0, 0.0, 9.0), Vec3(0.0, 0.0, -1.2), 30));
  input.Objects[0].OrientationGiven = 0;
  RotationOptions options;
  options.MaximumTurn = 20.0;
  const RotationOutput output = Refine(input, options);
  for (std::size_t k = 0; k + 1 < output.Poses[0].Orientations.size(); ++k)
  {
    EXPECT_LT(Angle(output.Poses[0].Orientations[k + 1], output.Poses[0].Orientations[k]),
              20.0001 / 180.0 * std::acos(-1.0));
  }
}
