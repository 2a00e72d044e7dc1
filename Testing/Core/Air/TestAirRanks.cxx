// SPDX-License-Identifier: BSD-3-Clause
// One air for many bodies by several ranks: the bytes of one.
#include "Air/Run/AirAssimilation.h"
#include "Air/Run/AirCorrection.h"
#include "Air/Run/EachBody.h"
#include "Air/Run/TouchingBodies.h"
#include "Base/Primitives.h"
#include "Base/ThreadRanks.h"
#include "Rotation/BodyTurner.h"
#include "Shapes/ThinShape.h"
#include "StraightFlights.h"

#include <gtest/gtest.h>

using namespace waft;

namespace
{

constexpr int Frames = 46;
constexpr int Bodies = 210; // enough that all they do each by itself is divided

/// Leaves beside each other: some land, the others pass marks and are free from there on.
AssimilationInput Crowd()
{
  AssimilationInput input;
  input.Scene.Time = { Frames, 30.0 };
  input.Shapes.resize(1);
  EXPECT_TRUE(MakeBuiltinShape("leaf", 0.0, input.Shapes[0]));
  input.Turning.RasterSize = 16;
  input.Obstacles.push_back(FlatGround());
  for (int o = 0; o < Bodies; ++o)
  {
    MotionObject object;
    object.ObjectId = 3 * o;
    object.Position = Vec3(-0.4 + 0.06 * (o % 14), -0.4 + 0.06 * (o / 14), 0.4 + 0.05 * (o % 3));
    object.SettlingSpeed = 0.5;
    object.RestHeight = 0.01;
    object.ClearanceRadius = 0.05; // wider than the next one is away: they touch
    Constraint row;
    row.ObjectId = object.ObjectId;
    row.Row = o;
    row.Kind = o % 4 == 0 ? ConstraintKind::Rest : ConstraintKind::Position;
    row.Frame = o % 4 == 0 ? 38 : 12;
    row.Until = o % 4 == 0 ? Frames - 1 : -1;
    row.Value = object.Position + Vec3(0.1, -0.05, o % 4 == 0 ? 0.0 : -0.1);
    AddStraightFlight(object, row, Frames, input);
  }
  return input;
}

AssimilationOptions Small()
{
  AssimilationOptions options;
  options.Resolution = options.LatticeResolution = 16;
  options.Rounds = options.WindRounds = options.Candidates = 1;
  options.Starts = 0;
  return options;
}

struct Flown
{
  AssimilationOutput Output;
  Result Outcome = Result::Ok();
  int Jobs = 0; // that another rank has heard of
  int Together = 0;
};

Flown FlownBy(int size, Monitor& monitor)
{
  Flown flown;
  std::atomic<int> jobs{ 0 }, together{ 0 };
  const auto turn = [&](ReadingStream& inputs, SharedItems& items)
  {
    ++jobs;
    return ServeTurning(inputs, items, 2, ThreadedFor(2));
  };
  EXPECT_TRUE(RunRanks(
    size,
    [&](Communicator& ranks)
    {
      AirElsewhere elsewhere(ranks);
      const auto serve = [&](ReadingStream& inputs, SharedItems& items)
      {
        ++jobs;
        return ServeBodies(inputs, items, 2, ThreadedFor(2), elsewhere);
      };
      const auto part = [&](ReadingStream& inputs, SharedItems&)
      {
        ++together;
        return ServeTouching(inputs, ranks, ThreadedFor(2), elsewhere);
      };
      if (!ranks.IsFirst())
      {
        Serve(ranks, { { BodiesKind, serve }, { TouchingKind, part }, { TurningKind, turn } });
        return;
      }
      AssimilationInput input = Crowd();
      input.Ranks = &ranks;
      flown.Outcome = AssimilateAir(input, Small(), {}, ThreadedFor(2), monitor, flown.Output);
      Release(ranks);
    }));
  flown.Jobs = size > 1 ? jobs / (size - 1) : 0;
  flown.Together = size > 1 ? together / (size - 1) : 0;
  return flown;
}

} // namespace

TEST(AirRanks, GiveTheBytesOfOne)
{
  SilentMonitor silent;
  const Flown one = FlownBy(1, silent);
  ASSERT_TRUE(one.Outcome) << one.Outcome.Message();
  int free = 0;
  for (const Constraint& row : one.Output.Constraints)
  {
    free += row.Row == OfNoRow ? 1 : 0;
  }
  EXPECT_GT(free, 0); // landings of that task
  for (const int size : { 2, 5 })
  {
    const Flown other = FlownBy(size, silent);
    ASSERT_TRUE(other.Outcome) << other.Outcome.Message();
    EXPECT_GE(other.Jobs, 4); // searches, drifts, turnings and landings
    EXPECT_GE(other.Together, 2);
    EXPECT_EQ(DigestOf(one.Output.Tracks), DigestOf(other.Output.Tracks)) << size;
    EXPECT_EQ(DigestOf(one.Output.Controls), DigestOf(other.Output.Controls)) << size;
    EXPECT_EQ(DigestOf(one.Output.Constraints), DigestOf(other.Output.Constraints)) << size;
    EXPECT_EQ(DigestOf(one.Output.Report), DigestOf(other.Output.Report)) << size;
    EXPECT_EQ(DigestOf(one.Output.Air->Velocity.Values),
              DigestOf(other.Output.Air->Velocity.Values));
    EXPECT_EQ(one.Output.Warnings, other.Output.Warnings);
  }
}

TEST(AirRanks, StopTogether)
{
  struct StoppingMonitor : Monitor
  {
    bool Tick(double, const std::string& text) override
    {
      return text.find("drift to their marks") == std::string::npos || ++this->Ticks < 3;
    }
    int Ticks = 0;
  };
  StoppingMonitor stopping;
  const Flown flown = FlownBy(3, stopping);
  EXPECT_TRUE(flown.Outcome.IsStopped());
  EXPECT_EQ(flown.Output.Tracks.size(), static_cast<std::size_t>(Bodies));
}
