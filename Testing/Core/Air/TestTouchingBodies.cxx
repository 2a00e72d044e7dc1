// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift/DriftTogether.h"
#include "Air/Run/AirSetup.h"
#include "Air/Run/TouchingBodies.h"
#include "Base/ThreadRanks.h"
#include "StraightFlights.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace waft;

namespace
{

constexpr int Frames = 24;

/// Balls in a lattice, nearer to each other than they keep, that sink in still air.
AssimilationInput Sheet(int columns, int rows)
{
  AssimilationInput input;
  input.Scene.Time = { Frames, 30.0 };
  for (int o = 0; o < columns * rows; ++o)
  {
    MotionObject object;
    object.ObjectId = o;
    object.Position = Vec3(-1.5 + 0.06 * (o % columns), -1.5 + 0.06 * (o / columns), 2.0);
    object.SettlingSpeed = 0.5;
    object.ClearanceRadius = 0.04;
    Constraint row;
    row.ObjectId = row.Row = o;
    row.Kind = ConstraintKind::Position;
    row.Frame = Frames - 1;
    row.Radius = 0.05;
    row.Value = object.Position + Vec3(0.0, 0.0, -0.4);
    AddStraightFlight(object, row, Frames, input);
  }
  return input;
}

struct Parted
{
  double Before = 0.0, After = 0.0; // how much nearer two are than they keep, in the mean [m]
  std::vector<std::vector<Vec3>> Paths;
};

Parted PartedBy(int columns, int rows, int threads, int iterations, Communicator* ranks)
{
  AssimilationInput input = Sheet(columns, rows);
  input.Ranks = ranks;
  const AssimilationOptions options;
  const ParallelFor parallel = ThreadedFor(threads);
  SilentMonitor silent;
  const SolidsOn none;
  AirContext run(input, options, none, parallel, silent);
  EXPECT_TRUE(run.Obstacles.Build(input.Obstacles));
  AirBodies bodies;
  AssimilationOutput output;
  EXPECT_TRUE(SetUpBodies(run, bodies, output));
  HalfSeries still;
  still.Dimensions = { 2, 2, 2 };
  still.Origin = Vec3(-2.0, -2.0, 0.0);
  still.Spacing = Vec3(4.0, 4.0, 4.0);
  for (int f = 0; f < Frames; ++f)
  {
    still.Times.push_back(f / 30.0);
    still.Values.emplace_back(8, Half3{});
  }
  const std::vector<DriftContact> contacts =
    FindContacts(KeptBy(bodies.Problems, 30.0), bodies.Paths, 0.5, parallel);
  const auto residue = [&]
  {
    double squares = 0.0;
    for (const std::vector<double>& own : ContactResidue(contacts, bodies.Paths))
    {
      for (const double depth : own)
      {
        squares += depth * depth;
      }
    }
    return std::sqrt(squares / static_cast<double>(Frames * bodies.Size()));
  };
  TouchingTask task;
  task.Which.assign(bodies.Size(), 1);
  task.Weights = run.Search.Weights;
  task.Iterations = iterations;
  Parted parted;
  parted.Before = residue();
  EXPECT_TRUE(SolveTouching(run, still, task, contacts, bodies, silent));
  EXPECT_TRUE(SolveTouching(run, still, task, contacts, bodies, silent)); // as each round does
  parted.After = residue();
  parted.Paths = std::move(bodies.Paths);
  return parted;
}

} // namespace

// Too many for one problem: they give way all the same, nearly as far as fewer do that are one.
TEST(TouchingBodies, GiveWayInParts)
{
  const Parted few = PartedBy(30, 30, 2, 16, nullptr);
  const Parted many = PartedBy(60, 40, 2, 16, nullptr);
  EXPECT_GT(many.Before, 0.005);
  EXPECT_LT(few.After, 0.4 * few.Before);
  EXPECT_LT(many.After, 0.4 * many.Before);
  for (const std::vector<Vec3>& path : many.Paths)
  {
    EXPECT_LT((path.back() - path.front() - Vec3(0.0, 0.0, -0.4)).norm(), 0.3);
  }
}

TEST(TouchingBodies, AreInTheSamePartsOnAnyNumberOfThreadsAndRanks)
{
  const Parted one = PartedBy(60, 40, 1, 2, nullptr);
  EXPECT_EQ(one.Paths, PartedBy(60, 40, 3, 2, nullptr).Paths);
  Parted first;
  EXPECT_TRUE(RunRanks(3,
                       [&](Communicator& ranks)
                       {
                         AirElsewhere elsewhere(ranks);
                         const auto part = [&](ReadingStream& inputs, SharedItems&)
                         { return ServeTouching(inputs, ranks, ThreadedFor(1), elsewhere); };
                         if (!ranks.IsFirst())
                         {
                           Serve(ranks, { { TouchingKind, part } });
                           return;
                         }
                         first = PartedBy(60, 40, 1, 2, &ranks);
                         Release(ranks);
                       }));
  EXPECT_EQ(one.Paths, first.Paths);
}
