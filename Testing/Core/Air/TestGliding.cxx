// SPDX-License-Identifier: BSD-3-Clause
// Bodies that go where their poses take them while they drift to their marks.
#include "Air/Field/AirSampler.h"
#include "Air/Run/AirAssimilation.h"
#include "Air/Run/AssimilationState.h"
#include "Base/Primitives.h"
#include "Shapes/ThinShape.h"
#include "StraightFlights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace waft;

namespace
{

constexpr int Frames = 90;

/// Leaves that pass a mark, and one that lands.
AssimilationInput Leaves()
{
  AssimilationInput input;
  input.Scene.Time = { Frames, 30.0 };
  input.Shapes.resize(1);
  EXPECT_TRUE(MakeBuiltinShape("leaf", 0.0, input.Shapes[0]));
  input.Obstacles.push_back(FlatGround());
  for (int o = 0; o < 4; ++o)
  {
    MotionObject object;
    object.ObjectId = o;
    object.Position = Vec3(-0.9 + 0.6 * o, 0.1 * o, o == 3 ? 1.2 : 2.5);
    object.SettlingSpeed = 0.5;
    object.RestHeight = 0.01;
    Constraint row;
    row.ObjectId = row.Row = o;
    row.Frame = o == 3 ? 80 : 60;
    row.Kind = o == 3 ? ConstraintKind::Rest : ConstraintKind::Position;
    row.Until = o == 3 ? Frames - 1 : -1;
    row.Value = object.Position + Vec3(0.2, -0.2, -1.0);
    AddStraightFlight(object, row, Frames, input);
  }
  return input;
}

AssimilationOptions Small()
{
  AssimilationOptions options;
  options.Resolution = 16;
  options.LatticeResolution = 16;
  options.Rounds = 1;
  options.Starts = 0;
  options.Candidates = 1;
  return options;
}

AssimilationOutput Flown(const AssimilationInput& input, const AssimilationOptions& options,
                         AssimilationState* memory = nullptr, int threads = 1)
{
  SilentMonitor monitor;
  AssimilationOutput output;
  const Result result =
    AssimilateAir(input, options, {}, ThreadedFor(threads), monitor, output, memory);
  EXPECT_TRUE(static_cast<bool>(result)) << result.Message();
  return output;
}

void ExpectSame(const Track& a, const Track& b)
{
  EXPECT_EQ(a.Positions, b.Positions);
  EXPECT_EQ(a.Slips, b.Slips);
  EXPECT_EQ(a.AngularVelocities, b.AngularVelocities);
}

TEST(Gliding, GoesBySlipAndControlToItsMarks)
{
  const AssimilationInput input = Leaves();
  const AssimilationOutput output = Flown(input, Small());
  for (int o = 0; o < 3; ++o)
  {
    EXPECT_EQ(output.Tracks[o].Positions[60], input.Constraints[o].Value);
  }
  double across = 0.0;
  for (const Track& track : output.Tracks)
  {
    const auto o = static_cast<std::size_t>(track.ObjectId);
    ASSERT_EQ(track.Slips.size(), static_cast<std::size_t>(Frames));
    ASSERT_EQ(track.Orientations.size(), static_cast<std::size_t>(Frames));
    const std::vector<Vec3>& x = track.Positions;
    for (std::size_t f = 5; f < 50; ++f)
    {
      // By steps, as a program would that knows no more than the outputs.
      Vec3 control = Vec3::Zero();
      for (const std::size_t k : { f - 1, f })
      {
        const double time = (static_cast<double>(k) + 0.5) / 30.0;
        const Vec3 middle = 0.5 * (x[k] + x[k + 1]);
        const Vec3 air = output.Air->Velocity.Around(time).Sample(middle, time);
        const Vec3 slip = 0.5 * (track.Slips[k] + track.Slips[k + 1]);
        control += 0.5 * (30.0 * (x[k + 1] - x[k]) - air - slip);
      }
      if (o < 3)
      {
        EXPECT_LT((output.Controls[o][f] - control).norm(), 0.02) << o << ", frame " << f;
      }
      across = std::max(across, track.Slips[f].head<2>().norm());
    }
  }
  EXPECT_GT(across, 0.1); // m/s
}

TEST(Gliding, TurnsInTheAirThroughWhichItGoes)
{
  AssimilationInput input = Leaves();
  EXPECT_TRUE(MakeBuiltinShape("feather", 0.0, input.Shapes[0])); // large in the eddies of the air
  const AssimilationOutput output = Flown(input, Small());
  RotationInput again;
  again.Scene = input.Scene;
  again.Shapes = input.Shapes;
  again.Objects = input.Objects;
  again.Tracks = output.Tracks;
  again.Constraints = output.Constraints;
  std::vector<std::vector<Vec3>> velocities;
  std::vector<std::vector<Mat3>> gradients;
  const AirSampler sampler(output.Air->Velocity);
  for (const Track& track : output.Tracks)
  {
    velocities.emplace_back();
    gradients.emplace_back();
    for (int k = 0; k < Frames; ++k)
    {
      Mat3 gradient;
      velocities.back().push_back(
        sampler.At(k, track.Positions[static_cast<std::size_t>(k)], &gradient));
      gradients.back().push_back(gradient);
    }
  }
  const AirOnTracks air(velocities, gradients);
  again.Air = &air;
  SilentMonitor monitor;
  RotationOutput turned;
  ASSERT_TRUE(RunRotationRefine(again, RotationOptions(), SerialFor(), monitor, turned));
  std::vector<double> away; // rad
  for (const std::vector<double>& own : turned.Away)
  {
    away.insert(away.end(), own.begin(), own.end());
  }
  std::sort(away.begin(), away.end());
  ASSERT_GT(away.size(), 20u);
  const double degree = std::acos(-1.0) / 180.0;
  EXPECT_LT(away[away.size() / 2], 15.0 * degree);
  EXPECT_LT(away[9 * away.size() / 10], 45.0 * degree);
  std::printf("agreement of feathers: %.1f, %.1f degrees\n", away[away.size() / 2] / degree,
              away[9 * away.size() / 10] / degree);
}

TEST(Gliding, IsTheSameOnAnyNumberOfThreads)
{
  const AssimilationOutput one = Flown(Leaves(), Small());
  const AssimilationOutput three = Flown(Leaves(), Small(), nullptr, 3);
  for (std::size_t o = 0; o < one.Tracks.size(); ++o)
  {
    ExpectSame(one.Tracks[o], three.Tracks[o]);
  }
}

TEST(Gliding, AnEditLeavesTheOthersTheirPathsAndPoses)
{
  AssimilationState memory;
  AssimilationInput input = Leaves();
  const AssimilationOutput before = Flown(input, Small(), &memory);
  input.Constraints[1].Value += Vec3(0.1, 0.0, 0.1);
  const AssimilationOutput after = Flown(input, Small(), &memory);
  EXPECT_EQ(after.Tracks[1].Positions[60], input.Constraints[1].Value);
  ASSERT_EQ(after.Tracks[1].Slips.size(), static_cast<std::size_t>(Frames));
  for (const std::size_t o : { 0u, 2u, 3u })
  {
    ExpectSame(before.Tracks[o], after.Tracks[o]);
  }
  // Other bodies fly otherwise.
  input = Leaves();
  input.Shapes[0].DragCoefficient *= 1.5;
  const AssimilationOutput other = Flown(input, Small(), &memory);
  EXPECT_NE(other.Tracks[0].Slips, before.Tracks[0].Slips);
}

TEST(Gliding, ACheckpointGoesOnToTheSameBits)
{
  class StopsAt : public Monitor
  {
  public:
    bool Tick(double fraction, const std::string&) override { return fraction < 0.6; }
  };
  const AssimilationOutput whole = Flown(Leaves(), Small());
  AssimilationOptions options = Small();
  options.CheckpointFile = testing::TempDir() + "waft-gliding.state";
  StopsAt stopping;
  AssimilationOutput stopped;
  EXPECT_TRUE(AssimilateAir(Leaves(), options, {}, SerialFor(), stopping, stopped).IsStopped());
  const AssimilationOutput resumed = Flown(Leaves(), options);
  for (std::size_t o = 0; o < whole.Tracks.size(); ++o)
  {
    ExpectSame(whole.Tracks[o], resumed.Tracks[o]);
  }
}

TEST(Gliding, WithoutGlideBodiesSinkStraightDown)
{
  AssimilationOptions options = Small();
  options.Glide = 0.0;
  const AssimilationOutput straight = Flown(Leaves(), options);
  AssimilationInput shapeless = Leaves();
  shapeless.Shapes.clear();
  const AssimilationOutput other = Flown(shapeless, Small());
  for (std::size_t o = 0; o < straight.Tracks.size(); ++o)
  {
    EXPECT_TRUE(straight.Tracks[o].Slips.empty());
    EXPECT_EQ(straight.Tracks[o].Positions, other.Tracks[o].Positions);
  }
  options.Glide = 0.5;
  const AssimilationOutput half = Flown(Leaves(), options);
  EXPECT_FALSE(half.Tracks[0].Slips.empty());
}

} // namespace
