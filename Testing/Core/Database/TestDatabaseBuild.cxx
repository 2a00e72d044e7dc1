// SPDX-License-Identifier: BSD-3-Clause
#include "Base/TemporaryFolder.h"
#include "Base/ThreadRanks.h"
#include "Database/DatabaseBuild.h"
#include "Database/SimulationRun.h"
#include "Obstacles/ObstacleSet.h"
#include "Trajectory/SameDatabase.h"
#include "Trajectory/Style.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <thread>

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

struct Built
{
  MotionDatabase Database;
  std::vector<CoveragePoint> Coverage;
  Result Outcome = Result::Ok();
};

Built BuildWith(const DatabaseOptions& options, int threads, Monitor& monitor)
{
  Built built;
  built.Outcome =
    BuildDatabase(options, ThreadedFor(threads), monitor, built.Database, built.Coverage);
  return built;
}

Built BuildAll(const DatabaseOptions& options, int threads)
{
  SilentMonitor monitor;
  Built built = BuildWith(options, threads, monitor);
  EXPECT_TRUE(built.Outcome) << built.Outcome.Message();
  return built;
}

MotionDatabase Build(const DatabaseOptions& options, int threads)
{
  return BuildAll(options, threads).Database;
}

// Stops from a fraction on; remembers the first one.
class StopFrom : public Monitor
{
public:
  explicit StopFrom(double fraction) : Limit(fraction) {}
  double First = -1.0;
  bool Tick(double fraction, const std::string& text) override
  {
    EXPECT_GE(fraction, this->Last);
    EXPECT_LE(fraction, 1.0);
    EXPECT_FALSE(text.empty());
    this->First = this->First < 0.0 ? fraction : this->First;
    this->Last = fraction;
    return fraction < this->Limit;
  }

private:
  double Limit;
  double Last = 0.0;
};

/// The progress at which this many of three simulations are done.
double After(double simulations)
{
  return 0.95 * simulations / 3.0;
}

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
  const Built one = BuildAll(options, 1);
  options.SimulationsAtOnce = 2;
  const Built two = BuildAll(options, 2);
  test::ExpectSame(one.Database, two.Database);
  ASSERT_EQ(one.Coverage.size(), 2u);
  ASSERT_EQ(two.Coverage.size(), 2u);
  EXPECT_EQ(one.Coverage[1].NewShare, two.Coverage[1].NewShare);
  options.Seed = 2;
  EXPECT_NE(Build(options, 2).TopSpeed, one.Database.TopSpeed);
}

TEST(DatabaseBuild, RunsAreTracedAroundTheirObstacles)
{
  DatabaseOptions options = Small();
  options.Ensemble.NumberOfObstacles = 4;
  SimulationRun run;
  ASSERT_TRUE(run.Begin(options, 0));
  SilentMonitor monitor;
  for (int step = 0; step < StepsOfSimulation(options); ++step)
  {
    const Result result = run.Step(monitor);
    ASSERT_TRUE(result) << result.Message();
  }
  const TracedSimulation traced = run.Finish();
  EnsembleOptions scene = options.Ensemble;
  scene.Seed = SimulationSeed(options.Seed, 0);
  scene.NumberOfFrames = options.NumberOfFrames;
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
  for (int step = 0; step < StepsOfSimulation(options); ++step)
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

TEST(DatabaseBuild, RefusesAWarmUpOfMoreFramesThanASceneMayHave)
{
  DatabaseOptions options = Small();
  for (const double seconds : { -1.0, 1e9, std::nan("") })
  {
    options.WarmUpSeconds = seconds;
    const Result result = options.Validate();
    ASSERT_FALSE(result) << seconds;
    EXPECT_EQ(result.Message().find("WarmUpSeconds: expected"), 0u) << result.Message();
  }
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
  for (int step = 0; step < StepsOfSimulation(options); ++step)
  {
    ASSERT_TRUE(run.Step(monitor));
  }
  const TracedSimulation traced = run.Finish();

  EnsembleOptions scene = options.Ensemble;
  scene.Seed = SimulationSeed(options.Seed, 1);
  scene.NumberOfFrames = 2;
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

TEST(DatabaseBuild, IsTheSameOnAnyNumberOfRanks)
{
  const test::TemporaryFolder folder;
  DatabaseOptions options = Small();
  options.NumberOfSimulations = 5;
  options.NumberOfFrames = 40;
  options.Resolution = 12;
  options.SettlingSpeed = 0.3; // which the other ranks have to be told
  const Built alone = BuildAll(options, 2);
  const auto onRanks = [&options](int size, Monitor& monitor)
  {
    Built built;
    std::vector<int> served(static_cast<std::size_t>(size), 0);
    const auto serve = [](int& count)
    {
      return [&count](ReadingStream& inputs, SharedItems& items)
      {
        ++count;
        return ServeSimulations(inputs, items, 2, SerialFor());
      };
    };
    EXPECT_TRUE(RunRanks(size,
                         [&](Communicator& ranks)
                         {
                           if (!ranks.IsFirst())
                           {
                             Serve(ranks, { { SimulationKind, serve(served[ranks.Rank()]) } });
                             return;
                           }
                           built.Outcome = BuildDatabase(options, ranks, SerialFor(), monitor,
                                                         built.Database, built.Coverage);
                           Release(ranks);
                         }));
    EXPECT_EQ(std::count(served.begin(), served.end(), 1), size - 1);
    return built;
  };
  SilentMonitor silent;
  for (const int size : { 2, 3, 7 })
  {
    options.SimulationsAtOnce = size == 3 ? 2 : 1;
    options.KeptIn = size == 2 ? "" : folder.File("kept" + std::to_string(size));
    const Built built = onRanks(size, silent);
    ASSERT_TRUE(built.Outcome) << built.Outcome.Message();
    test::ExpectSame(built.Database, alone.Database);
    ASSERT_EQ(built.Coverage.size(), alone.Coverage.size());
    EXPECT_EQ(built.Coverage.back().NewShare, alone.Coverage.back().NewShare);
  }
  // Kept by the first alone: all are read, but one that was lost.
  std::filesystem::remove(options.KeptIn + "/simulation2");
  test::ExpectSame(onRanks(2, silent).Database, alone.Database);

  options.KeptIn.clear();
  StopFrom monitor(0.4);
  const Built stopped = onRanks(2, monitor);
  EXPECT_TRUE(stopped.Outcome.IsStopped());
  EXPECT_LT(stopped.Coverage.size() + 1, 5u);
  options.StopBelow = 1.0;
  const Built covered = onRanks(3, silent);
  EXPECT_TRUE(covered.Outcome && !covered.Outcome.IsStopped());
  EXPECT_EQ(covered.Coverage.size(), 1u);
}

TEST(DatabaseBuild, StoppedItGivesTheSimulationsThatAreWhole)
{
  DatabaseOptions options = Small();
  options.SimulationsAtOnce = 1;
  for (const double fraction : { 0.0, 0.01, After(0.9) })
  {
    StopFrom monitor(fraction);
    const Built built = BuildWith(options, 1, monitor);
    EXPECT_TRUE(built.Outcome.IsStopped()) << fraction;
    EXPECT_TRUE(built.Database.Segments.empty());
    EXPECT_TRUE(built.Coverage.empty());
  }
  // When all are whole, it is clustered to the end.
  StopFrom clustering(0.96);
  const Built whole = BuildWith(options, 1, clustering);
  EXPECT_TRUE(whole.Outcome && !whole.Outcome.IsStopped());
  EXPECT_EQ(whole.Database.Provenance.at("NumberOfSimulations"), "3");

  StopFrom inTheThird(After(2.5));
  const Built stopped = BuildWith(options, 1, inTheThird);
  EXPECT_TRUE(stopped.Outcome.IsStopped());
  options.NumberOfSimulations = 2;
  test::ExpectSame(stopped.Database, Build(options, 1));
  ASSERT_EQ(stopped.Coverage.size(), 1u);
}

TEST(DatabaseBuild, StopsWhereSimulationsTakeLessThanATurn)
{
  DatabaseOptions options = Small();
  options.NumberOfSimulations = 1000;
  options.NumberOfFrames = 40;
  options.WarmUpSeconds = 0.0;
  options.Resolution = 8;
  options.SimulationsAtOnce = 1;
  // The caller's thread takes no part, as with a pool: whole simulations are done between its
  // looks.
  const ParallelFor elsewhere =
    [](std::size_t count, const std::function<void(std::size_t, std::size_t)>& body)
  { std::thread([&] { body(0, count); }).join(); };
  StopFrom monitor(0.0);
  Built built;
  built.Outcome = BuildDatabase(options, elsewhere, monitor, built.Database, built.Coverage);
  EXPECT_TRUE(built.Outcome.IsStopped()) << built.Outcome.Message();
  // Where one takes longer than a turn, as on a slow machine, it is cut off: then there is none.
  const std::string done = built.Database.Provenance["NumberOfSimulations"];
  EXPECT_TRUE(done == "1" || done.empty()) << done;
}

TEST(DatabaseBuild, GoesOnWithWhatWasKept)
{
  const test::TemporaryFolder folder;
  const std::string kept = folder.File("kept"); // is made
  const auto fileOf = [&](int simulation)
  { return kept + "/simulation" + std::to_string(simulation); };
  const auto numberOfFiles = [&]
  { return std::distance(std::filesystem::directory_iterator(kept), {}); };
  DatabaseOptions options = Small();
  const Built whole = BuildAll(options, 1);
  options.KeptIn = kept;
  options.SimulationsAtOnce = 1;
  StopFrom inTheThird(After(2.5));
  EXPECT_TRUE(BuildWith(options, 1, inTheThird).Outcome.IsStopped());
  EXPECT_EQ(numberOfFiles(), 2);

  StopFrom never(2.0);
  const Built resumed = BuildWith(options, 1, never);
  EXPECT_TRUE(resumed.Outcome && !resumed.Outcome.IsStopped());
  EXPECT_GE(never.First, After(1.0)); // nothing of the first is done again
  EXPECT_EQ(numberOfFiles(), 3);
  test::ExpectSame(resumed.Database, whole.Database);
  EXPECT_EQ(resumed.Coverage[1].NewShare, whole.Coverage[1].NewShare);

  // A damaged one is simulated again, the others are not.
  std::filesystem::resize_file(fileOf(0), std::filesystem::file_size(fileOf(0)) / 2);
  StopFrom again(2.0);
  test::ExpectSame(BuildWith(options, 1, again).Database, whole.Database);
  EXPECT_LT(again.First, After(1.0));
  {
    std::fstream file(fileOf(2), std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(5000);
    file.put('\x7f');
  }
  test::ExpectSame(BuildAll(options, 2).Database, whole.Database);

  // So are those of other parameters; what is made of them is not a parameter of a simulation.
  options.Cluster.MaximumSegments = 200;
  StopFrom thinner(2.0);
  EXPECT_EQ(BuildWith(options, 1, thinner).Database.Segments.size(), 200u);
  EXPECT_GE(thinner.First, After(2.9));
  options.Seed = 9;
  StopFrom other(2.0);
  EXPECT_NE(BuildWith(options, 1, other).Database.TopSpeed, whole.Database.TopSpeed);
  EXPECT_LT(other.First, After(1.0));

  options.KeptIn = fileOf(0) + "/below";
  SilentMonitor monitor;
  EXPECT_NE(BuildWith(options, 1, monitor).Outcome.Message().find("folder"), std::string::npos);
}

TEST(DatabaseBuild, EndsWhereHardlyAnythingIsNew)
{
  DatabaseOptions options = Small();
  options.NumberOfSimulations = 5;
  options.SimulationsAtOnce = 3;
  const Built all = BuildAll(options, 2);
  ASSERT_EQ(all.Coverage.size(), 4u);
  // The first fraction below the threshold is that of the simulation after `last`.
  std::size_t last = 1;
  while (last < 3 && all.Coverage[last].NewShare >= all.Coverage[0].NewShare)
  {
    ++last;
  }
  ASSERT_LT(all.Coverage[last].NewShare, all.Coverage[0].NewShare);
  options.StopBelow = 0.5 * (all.Coverage[last].NewShare + all.Coverage[0].NewShare);
  for (std::size_t i = 0; i < last; ++i)
  {
    ASSERT_GE(all.Coverage[i].NewShare, options.StopBelow);
  }
  const Built fewer = BuildAll(options, 2);
  EXPECT_EQ(fewer.Coverage.size(), last + 1);
  options.SimulationsAtOnce = 1;
  options.StopBelow = 0.0;
  options.NumberOfSimulations = static_cast<int>(last) + 2;
  test::ExpectSame(fewer.Database, Build(options, 1));
}

TEST(DatabaseBuild, RefusesWhatIsWrong)
{
  const auto message = [](const DatabaseOptions& options)
  {
    SilentMonitor monitor;
    return BuildWith(options, 1, monitor).Outcome.Message();
  };
  DatabaseOptions options = Small();
  options.Bounds.Max.z() = 3.9;
  EXPECT_NE(message(options).find("Bounds"), std::string::npos);
  options = Small();
  options.NumberOfSimulations = 0;
  EXPECT_NE(message(options).find("NumberOfSimulations"), std::string::npos);
  options = Small();
  options.Ensemble.WindAcceleration.front() = 9.0;
  EXPECT_NE(message(options).find("WindAcc"), std::string::npos);
  options = Small();
  options.StopBelow = 1.5;
  EXPECT_NE(message(options).find("StopBelow"), std::string::npos);
  options = Small();
  options.CoverageTolerance = 0.0;
  EXPECT_NE(message(options).find("CoverageTolerance"), std::string::npos);
}
