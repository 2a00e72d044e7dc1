// SPDX-License-Identifier: BSD-3-Clause
#include "Database/DatabaseBuild.h"
#include "Database/SimulationRun.h"
#include "Obstacles/ObstacleSet.h"
#include "Trajectory/Style.h"

#include <gtest/gtest.h>

using namespace waft;

namespace
{

DatabaseOptions Small()
{
  DatabaseOptions options;
  options.NumberOfSimulations = 3;
  options.NumberOfFrames = 60;
  options.Resolution = 16;
  options.WarmUpSeconds = 1.0;
  options.Trace.SeedStride = 2;
  return options;
}

MotionDatabase Build(const DatabaseOptions& options, int threads)
{
  MotionDatabase database;
  SilentMonitor monitor;
  const Result result = BuildDatabase(options, ThreadedFor(threads), monitor, database);
  EXPECT_TRUE(result) << result.Message();
  return database;
}

class StopAfter : public Monitor
{
public:
  explicit StopAfter(int ticks) : Left(ticks) {}
  bool Tick(double fraction, const std::string&) override
  {
    EXPECT_GE(fraction, this->Last);
    this->Last = fraction;
    return --this->Left >= 0;
  }

private:
  int Left;
  double Last = 0.0;
};

} // namespace

TEST(DatabaseBuild, IsWholeAndHoldsEverySimulation)
{
  const MotionDatabase database = Build(Small(), 1);
  const Result result = database.Validate();
  ASSERT_TRUE(result) << result.Message();
  std::vector<int> counts(3, 0);
  for (const Segment& segment : database.Segments)
  {
    ++counts[segment.Simulation];
  }
  for (const int count : counts)
  {
    EXPECT_GT(count, 50);
  }
  EXPECT_GT(database.TopSpeed, 0.3);
  EXPECT_FALSE(database.Vortices.empty());
  EXPECT_EQ(database.Provenance.at("Seed"), "1");
  EXPECT_EQ(database.Provenance.at("Resolution"), "16");
  EXPECT_EQ(database.Provenance.at("Bounds"), "-2 2 -2 2 0 4");
}

TEST(DatabaseBuild, NeitherThreadsNorBatchesChangeABit)
{
  DatabaseOptions options = Small();
  options.SimulationsAtOnce = 1;
  const MotionDatabase one = Build(options, 1);
  options.SimulationsAtOnce = 2;
  const MotionDatabase two = Build(options, 2);
  EXPECT_EQ(one.Provenance, two.Provenance);
  ASSERT_EQ(one.Segments.size(), two.Segments.size());
  for (std::size_t s = 0; s < one.Segments.size(); ++s)
  {
    ASSERT_EQ(one.Segments[s].Coefficients, two.Segments[s].Coefficients);
    ASSERT_EQ(one.Segments[s].VortexIds, two.Segments[s].VortexIds);
  }
  ASSERT_EQ(one.Nodes.size(), two.Nodes.size());
  for (std::size_t n = 0; n < one.Nodes.size(); ++n)
  {
    ASSERT_EQ(one.Nodes[n].Medoid, two.Nodes[n].Medoid);
  }
  options.Seed = 2;
  EXPECT_NE(Build(options, 2).TopSpeed, one.TopSpeed);
}

TEST(DatabaseBuild, RunsAreTracedAroundTheirObstacles)
{
  DatabaseOptions options = Small();
  options.Ensemble.NumberOfObstacles = 4;
  SimulationRun run;
  ASSERT_TRUE(run.Begin(options, 0));
  SilentMonitor monitor;
  for (int step = 0; step < run.NumberOfSteps(); ++step)
  {
    const Result result = run.Step(monitor);
    ASSERT_TRUE(result) << result.Message();
  }
  const TracedSimulation traced = run.Finish();
  EnsembleOptions scene = options.Ensemble;
  scene.Seed = SimulationSeed(options.Seed, 0);
  scene.Time.NumberOfFrames = options.NumberOfFrames;
  scene.WarmUpSeconds = options.WarmUpSeconds;
  Ensemble ensemble;
  ASSERT_TRUE(MakeEnsemble(scene, ensemble));
  ASSERT_FALSE(ensemble.Obstacles.empty());
  ObstacleSet obstacles;
  ASSERT_TRUE(obstacles.Build(ensemble.Obstacles));
  EXPECT_EQ(traced.Vortices.size(), ensemble.Forces.Vortices.size());
  EXPECT_EQ(traced.Vortices[0].CenterTime, ensemble.Forces.Vortices[0].CenterTime);
  // The lattice of distances rounds edges off by less than a voxel.
  const double voxel = 4.0 / options.Resolution;
  std::size_t longest = 0;
  for (const Track& track : traced.Tracks)
  {
    longest = std::max(longest, track.Positions.size());
    for (const Vec3& x : track.Positions)
    {
      ASSERT_TRUE(options.Bounds.Contains(x));
      ASSERT_GT(obstacles.SignedDistance(x, 0.0), -0.75 * voxel);
    }
  }
  EXPECT_EQ(longest, 60u);
}

TEST(DatabaseBuild, StyleSurvivesCutsAndCompression)
{
  DatabaseOptions options = Small();
  options.NumberOfFrames = 90;
  SimulationRun run;
  ASSERT_TRUE(run.Begin(options, 2));
  SilentMonitor monitor;
  for (int step = 0; step < run.NumberOfSteps(); ++step)
  {
    ASSERT_TRUE(run.Step(monitor));
  }
  ClusterInput input;
  input.Simulations.push_back(run.Finish());
  StyleSamples traced;
  for (const Track& track : input.Simulations[0].Tracks)
  {
    AppendStyle(track.Positions, 1.0 / 30.0, traced);
  }
  MotionDatabase database;
  ASSERT_TRUE(ClusterTrajectories(input, options.Cluster, SerialFor(), monitor, database));
  const StyleSamples kept = StyleOf(database);
  EXPECT_LT(KolmogorovSmirnov(traced.LogCurvature, kept.LogCurvature), 0.1);
  EXPECT_LT(KolmogorovSmirnov(traced.Acceleration, kept.Acceleration), 0.08);
  EXPECT_LT(KolmogorovSmirnov(traced.Speed, kept.Speed), 0.08);
}

TEST(DatabaseBuild, WarmUpByStepsIsThatOfTheSolver)
{
  // The same air as when the solver warms up by itself, at the first frame of the tracers.
  DatabaseOptions options = Small();
  options.Ensemble.NumberOfObstacles = 0;
  options.NumberOfFrames = 2;
  SimulationRun run;
  ASSERT_TRUE(run.Begin(options, 1));
  SilentMonitor monitor;
  for (int step = 0; step < run.NumberOfSteps(); ++step)
  {
    ASSERT_TRUE(run.Step(monitor));
  }
  const TracedSimulation traced = run.Finish();

  EnsembleOptions scene = options.Ensemble;
  scene.Seed = SimulationSeed(options.Seed, 1);
  scene.Time.NumberOfFrames = 2;
  scene.WarmUpSeconds = options.WarmUpSeconds;
  Ensemble ensemble;
  ASSERT_TRUE(MakeEnsemble(scene, ensemble));
  SmokeOptions smoke;
  ASSERT_TRUE(SmokeOptionsOf(options, smoke));
  smoke.WarmUpSeconds = options.WarmUpSeconds;
  SmokeSolver solver;
  ASSERT_TRUE(solver.Begin(smoke, ensemble.Forces));
  ASSERT_TRUE(solver.Step(SerialFor(), monitor));
  SmokeFrame frame;
  solver.Read(frame);
  double fastest = 0.0;
  for (const Track& track : traced.Tracks)
  {
    ASSERT_EQ(track.Positions.size(), 2u);
    const Vec3 cell = (track.Positions[0] - frame.Origin).cwiseQuotient(frame.Spacing);
    const std::size_t index =
      static_cast<std::size_t>(std::lround(cell.x() + 16 * (cell.y() + 16 * cell.z())));
    const Vec3 expected(frame.Velocity[index][0], frame.Velocity[index][1],
                        frame.Velocity[index][2]);
    const Vec3 mean = (track.Positions[1] - track.Positions[0]) * 30.0;
    fastest = std::max(fastest, expected.norm());
    // Over one frame a tracer's velocity changes a little.
    EXPECT_LT((mean - expected).norm(), 0.12);
  }
  EXPECT_GT(fastest, 0.3);
}

TEST(DatabaseBuild, StopsWhenAskedAndRefusesWhatIsWrong)
{
  for (const int ticks : { 0, 5, 60, 100 })
  {
    MotionDatabase database;
    StopAfter monitor(ticks);
    const Result result = BuildDatabase(Small(), SerialFor(), monitor, database);
    EXPECT_TRUE(result.IsStopped()) << ticks;
    EXPECT_TRUE(database.Segments.empty());
  }
  MotionDatabase database;
  SilentMonitor monitor;
  DatabaseOptions options = Small();
  options.SimulationsAtOnce = 1;
  StopAfter inTheThird(200); // of 90 frames each
  EXPECT_TRUE(BuildDatabase(options, SerialFor(), inTheThird, database).IsStopped());
  options.NumberOfSimulations = 2;
  const MotionDatabase two = Build(options, 1);
  EXPECT_EQ(database.Provenance, two.Provenance);
  ASSERT_EQ(database.Segments.size(), two.Segments.size());
  EXPECT_EQ(database.Segments.back().Coefficients, two.Segments.back().Coefficients);

  database = MotionDatabase();
  options = Small();
  options.Bounds.Max.z() = 3.9;
  EXPECT_NE(BuildDatabase(options, SerialFor(), monitor, database).Message().find("Bounds"),
            std::string::npos);
  options = Small();
  options.NumberOfSimulations = 0;
  EXPECT_NE(
    BuildDatabase(options, SerialFor(), monitor, database).Message().find("NumberOfSimulations"),
    std::string::npos);
  options = Small();
  options.Ensemble.WindAcceleration.Low = 9.0;
  EXPECT_NE(BuildDatabase(options, SerialFor(), monitor, database).Message().find("WindAcc"),
            std::string::npos);
}
