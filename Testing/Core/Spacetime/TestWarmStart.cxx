// SPDX-License-Identifier: BSD-3-Clause
// Runs that go on from the motion of the last one.
#include "SpacetimeRuns.h"

#include <gtest/gtest.h>

using namespace waft;

namespace
{

SpacetimeInput Scene()
{
  SceneOptions scene;
  scene.NumberOfFrames = 40;
  scene.NumberOfObjects = 3;
  return MakeScene(scene);
}

SpacetimeOptions Options()
{
  SpacetimeOptions options = QuickOptions();
  options.NumberOfGasParticles = 125;
  return options;
}

std::size_t Iterations(const SpacetimeOutput& output)
{
  std::size_t count = 0;
  for (const ConvergenceRow& row : output.Convergence)
  {
    count += row.Iteration > 0 ? 1 : 0;
  }
  return count;
}

} // namespace

TEST(WarmStart, GoesOnAfterAChangedWeightAndReachesWhatAFreshRunReaches)
{
  const SpacetimeInput input = Scene();
  SpacetimeWarmStart memory;
  SpacetimeOptions options = Options();
  const SpacetimeOutput first = RunScene(input, options, 2, &memory);
  EXPECT_EQ(first.Convergence.front().Stage, "initial");
  // A memory changes nothing of a first run.
  ExpectSameMotion(first, RunScene(input, options));

  options.CoherenceWeight *= 2.0;
  const SpacetimeOutput fresh = RunScene(input, options);
  const SpacetimeOutput next = RunScene(input, options, 2, &memory);
  EXPECT_EQ(next.Convergence.front().Stage, "so far");
  EXPECT_LT(Iterations(next), Iterations(fresh) / 2);
  EXPECT_LT(next.Convergence.back().E, next.Convergence.front().E);
  EXPECT_LT(next.Convergence.back().E, 1.05 * fresh.Convergence.back().E);
  for (const ReportRow& row : next.Report)
  {
    EXPECT_EQ(row.Status, ConstraintStatus::Met);
  }
  // And on, where nothing has changed: from where it stopped.
  const SpacetimeOutput again = RunScene(input, options, 2, &memory);
  EXPECT_EQ(again.Convergence.front().E, next.Convergence.back().E);
  EXPECT_LE(again.Convergence.back().E, next.Convergence.back().E);
  // Without WarmStart, or with other unknowns, from the planned tracks.
  options.WarmStart = false;
  ExpectSameMotion(RunScene(input, options, 2, &memory), fresh);
  options.WarmStart = true;
  options.NumberOfGasParticles = 64;
  EXPECT_EQ(RunScene(input, options, 2, &memory).Convergence.front().Stage, "initial");
  SceneOptions longer;
  longer.NumberOfFrames = 41;
  EXPECT_EQ(RunScene(MakeScene(longer), options, 2, &memory).Convergence.front().Stage, "initial");
}

TEST(WarmStart, GoesOnInTheStageWhereItWasStopped)
{
  const SpacetimeInput input = Scene();
  SpacetimeWarmStart memory;
  StopAt monitor(0.5);
  SpacetimeOutput stopped;
  const Result result = RunSpacetime(input, Options(), ThreadedFor(2), monitor, stopped, &memory);
  ASSERT_TRUE(result && result.IsStopped());
  const std::string stage = stopped.Convergence[stopped.Convergence.size() - 2].Stage;
  EXPECT_NE(stage.find("coarse"), std::string::npos);
  const SpacetimeOutput next = RunScene(input, Options(), 2, &memory);
  EXPECT_EQ(next.Convergence[0].Stage, "so far");
  EXPECT_EQ(next.Convergence[1].Stage, stage);
  EXPECT_LT(next.Convergence.back().E, 0.9 * stopped.Convergence.back().E);
  const SpacetimeOutput fresh = RunScene(input, Options());
  EXPECT_LT(next.Convergence.back().E, 1.1 * fresh.Convergence.back().E);
}

TEST(WarmStart, SaysSoWhenNothingCanBeBettered)
{
  const SpacetimeInput input = Scene();
  SpacetimeWarmStart memory;
  SpacetimeOptions options = Options();
  options.Tolerance = 0.05;
  SpacetimeOutput output;
  bool said = false;
  for (int k = 0; k < 12 && !said; ++k)
  {
    output = RunScene(input, options, 2, &memory);
    said = !output.Warnings.empty();
  }
  ASSERT_TRUE(said);
  EXPECT_NE(output.Warnings[0].find("nothing can be bettered"), std::string::npos);
  EXPECT_GT(output.Convergence.back().E, 0.95 * output.Convergence.front().E);
}

TEST(WarmStart, BeginsAnewWithAWindOnAnotherLattice)
{
  const SpacetimeInput input = Scene();
  SpacetimeWarmStart memory;
  SpacetimeOptions options = Options();
  RunScene(input, options, 2, &memory);
  options.WindCells = 4;
  const SpacetimeOutput output = RunScene(input, options, 2, &memory);
  EXPECT_EQ(output.Convergence.front().Stage, "initial");
  EXPECT_EQ(output.Wind.Dimensions, WindLatticeDimensions(input.Scene.Bounds, options));
  options.FieldRidge = 0.005;
  EXPECT_EQ(RunScene(input, options, 2, &memory).Convergence.front().Stage, "so far");
}

TEST(WarmStart, TakesInVorticesThatSomebodyMoved)
{
  SpacetimeInput input = Scene();
  SpacetimeWarmStart memory;
  SpacetimeOptions options = Options();
  options.FitVortexFields = false;
  RunScene(input, options, 2, &memory);
  input.Vortices[0].P1.x() += 0.3;
  input.Vortices[0].P2.x() += 0.3;
  const SpacetimeOutput moved = RunScene(input, options, 2, &memory);
  EXPECT_EQ(moved.Convergence.front().Stage, "so far");
  ASSERT_EQ(moved.Vortices.size(), 1u);
  EXPECT_NEAR(moved.Vortices[0].P1.x(), input.Vortices[0].P1.x(), 1e-12);
  input.Vortices.clear();
  EXPECT_TRUE(RunScene(input, options, 2, &memory).Vortices.empty());
}
