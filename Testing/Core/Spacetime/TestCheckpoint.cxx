// SPDX-License-Identifier: BSD-3-Clause
// Runs that are killed, and go on.
#include "Base/ReadingStream.h"
#include "Base/TemporaryFolder.h"
#include "Spacetime/Run/SolverState.h"
#include "SpacetimeRuns.h"
#include "Store/StateFile.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <fstream>
#include <functional>
#include <string>
#include <utility>

#include <sys/wait.h>
#include <unistd.h>

using namespace waft;

namespace
{

std::string CheckpointPath(const char* name)
{
  static const test::TemporaryFolder folder;
  std::string path = folder.File(name);
  std::remove(path.c_str());
  return path;
}

SpacetimeInput Scene()
{
  SceneOptions scene;
  scene.NumberOfFrames = 40;
  return MakeScene(scene);
}

SpacetimeOptions Options(const std::string& path)
{
  SpacetimeOptions options = QuickOptions();
  options.NumberOfGasParticles = 125;
  options.NumberOfObjectParticles = 12;
  options.MaximumNumberOfIterations = 16;
  options.CheckpointFile = path;
  options.CheckpointInterval = 0.0;
  return options;
}

/// Does something when the run has come so far.
class At : public Monitor
{
public:
  explicit At(double fraction) : Fraction(fraction) {}
  bool Tick(double fraction, const std::string& text) override
  {
    this->Ticks += fraction >= this->Fraction ? 1 : 0;
    return this->Ticks < 3 || this->Reached(text);
  }
  virtual bool Reached(const std::string&) { return false; }

private:
  double Fraction;
  int Ticks = 0;
};

class KillAt : public At
{
public:
  using At::At;
  bool Reached(const std::string&) override { return std::raise(SIGKILL) == 0; }
};

/// Asks to stop at one call, or at one of those that say something.
class StopAfter : public Monitor
{
public:
  explicit StopAfter(int ticks, std::string text = "") : Left(ticks), Wanted(std::move(text)) {}
  bool Tick(double, const std::string& text) override
  {
    this->Left -= text.find(this->Wanted) != std::string::npos ? 1 : 0;
    return this->Left > 0;
  }

private:
  int Left;
  std::string Wanted;
};

class FirstTick : public Monitor
{
public:
  bool Tick(double fraction, const std::string&) override
  {
    this->First = this->First < 0.0 ? fraction : this->First;
    return true;
  }
  double First = -1.0;
};

} // namespace

TEST(Checkpoint, AKilledRunEndsAsIfItHadNeverBeenKilled)
{
  const SpacetimeInput input = Scene();
  const SpacetimeOutput whole = RunScene(input, Options(""));
  // In the leash, in a free stage of each coarse level, and in a fine one; each from the start.
  for (const double fraction : { 0.08, 0.18, 0.5, 0.85 })
  {
    const std::string path = CheckpointPath("killed");
    const pid_t child = ::fork();
    if (child == 0)
    {
      KillAt monitor(fraction);
      SpacetimeOutput output;
      (void)RunSpacetime(input, Options(path), SerialFor(), monitor, output);
      ::_exit(0);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL) << fraction;
    ASSERT_TRUE(FileExists(path)) << fraction;
    FirstTick monitor;
    SpacetimeOutput output;
    ASSERT_TRUE(RunSpacetime(input, Options(path), ThreadedFor(2), monitor, output));
    EXPECT_GT(monitor.First, 0.9 * fraction); // it goes on, not over it all again
    EXPECT_TRUE(output.Warnings.empty());
    ExpectSameMotion(output, whole);
    EXPECT_FALSE(FileExists(path)); // removed when it is done
  }
}

namespace
{

constexpr int MoreTicksThanFrames = 45;

/// Stops a run as soon as the gas is moved, then again and again after so many ticks, until one
/// ends by itself. Returns how often it was stopped.
int RunInPieces(const SpacetimeInput& input, const SpacetimeOptions& options, int ticks,
                SpacetimeOutput& output)
{
  for (int stops = 0; stops < 100; ++stops)
  {
    StopAfter monitor(FileExists(options.CheckpointFile) ? ticks : MoreTicksThanFrames);
    output = SpacetimeOutput();
    const Result result = RunSpacetime(input, options, ThreadedFor(2), monitor, output);
    EXPECT_TRUE(result) << result.Message();
    EXPECT_TRUE(output.Warnings.empty());
    if (!result || !result.IsStopped())
    {
      return stops;
    }
  }
  ADD_FAILURE() << "no way on";
  return 0;
}

// Writes nothing at intervals.
SpacetimeOptions BriefOptions(int leashIterations, int iterations)
{
  SpacetimeOptions options = Options("");
  options.LeashIterations = leashIterations;
  options.MaximumNumberOfIterations = iterations;
  options.CheckpointInterval = 1e6;
  return options;
}

} // namespace

// Nothing is written at intervals: where it goes on from is written when it is stopped, be it in a
// line search, in the first evaluation of a stage, in an update of the fields. A step that is
// stopped begins anew, so each piece holds one at its longest: two searches of ten trials.
TEST(Checkpoint, ARunStoppedAgainAndAgainEndsAsIfItHadNeverBeenStopped)
{
  const SpacetimeInput input = Scene();
  SpacetimeOptions options = BriefOptions(4, 18);
  const SpacetimeOutput whole = RunScene(input, options);
  for (const auto& [ticks, least] : { std::pair(23, 4), std::pair(26, 4), std::pair(29, 4) })
  {
    const std::string path = CheckpointPath("pieces");
    options.CheckpointFile = path;
    SpacetimeOutput output;
    const int stops = RunInPieces(input, options, ticks, output);
    EXPECT_GT(stops, least) << ticks;
    ExpectSameMotion(output, whole);
    EXPECT_FALSE(FileExists(path));
  }
}

TEST(Checkpoint, AnUpdateOfTheFieldsThatIsStoppedIsDoneAnew)
{
  const SpacetimeInput input = Scene();
  SpacetimeOptions options = BriefOptions(2, 6);
  const SpacetimeOutput whole = RunScene(input, options);
  options.CheckpointFile = CheckpointPath("fields");
  int stops = 0;
  for (int ticks = 1; ticks < 100; ticks += 13)
  {
    StopAfter monitor(ticks, "solving for the air's fields");
    SpacetimeOutput output;
    const Result result = RunSpacetime(input, options, ThreadedFor(2), monitor, output);
    ASSERT_TRUE(result) << result.Message();
    if (!result.IsStopped())
    {
      break;
    }
    ++stops;
    ASSERT_TRUE(FileExists(options.CheckpointFile));
    ExpectSameMotion(RunScene(input, options), whole);
  }
  EXPECT_GT(stops, 3);
}

TEST(Checkpoint, ATimeLimitLeavesTheCourseThatARunWithoutItTakes)
{
  const SpacetimeInput input = Scene();
  const SpacetimeOutput whole = RunScene(input, Options(""));
  const std::string path = CheckpointPath("limited");
  SpacetimeOptions limited = Options(path);
  limited.CheckpointInterval = 1e6;
  // On a busy machine the first run may have been the slower one: a shorter limit then.
  SpacetimeOutput cut;
  for (double fraction = 0.3; fraction > 0.01 && !FileExists(path); fraction *= 0.5)
  {
    limited.TimeLimit = fraction * whole.Convergence.back().Seconds;
    cut = RunScene(input, limited);
  }
  ASSERT_EQ(cut.Warnings.size(), 1u);
  ASSERT_TRUE(FileExists(path));
  ExpectSameMotion(RunScene(input, Options(path)), whole);
}

std::vector<char> BytesOf(const SolverState& state)
{
  MemoryStream stream;
  stream.Values(state);
  return stream.Content;
}

TEST(SolverState, GoesToBytesAndBackWithoutALoss)
{
  SolverState state;
  state.Plan.CoarseFrames = { { 0, 2, 4 } };
  Stage stage;
  stage.Kind = StageKind::Leash;
  stage.Coarseness = 1;
  stage.Leash = 0.25;
  state.Plan.Stages = { stage, Stage() };
  state.Next = 1;
  state.Coarseness = 1;
  state.StartEnergy = 3.5;
  state.Seconds = 12.0;
  state.Log.resize(2);
  state.Log[1].Stage = "free 1";
  state.Fields.Vortices.resize(1);
  state.Fields.Wind.Knots = { { 0.5f, 0.25f } };
  state.Motion = { 7.0f };
  state.Beginning = { 8.0f, 9.0f };
  state.Part = { 0.0f, 1.0f, 2.0f, 3.0f, 4.0f, 5.0f };
  state.Curvature.Pairs = { { state.Part }, { state.Part }, { 0.125 } };
  state.Curvature.Gradient = state.Part;
  state.Curvature.Energies = { 3.0, 2.0 };
  state.Sweep.Energies = { 1.0 };
  const std::vector<char> bytes = BytesOf(state);

  ReadingStream reader(bytes);
  SolverState back;
  reader.Values(back);
  EXPECT_TRUE(reader.IsGood());
  EXPECT_EQ(reader.Left(), 0u);
  EXPECT_EQ(BytesOf(back), bytes);
  EXPECT_EQ(back.Now().Name(), "free 1");
  EXPECT_EQ(back.Curvature.NumberOfIterations(), 1);

  const std::vector<std::function<void(SolverState&)>> changes = {
    [](SolverState& s) { s.Plan.Stages[0].Leash = 0.5; },
    [](SolverState& s) { s.IsInside = true; },
    [](SolverState& s) { s.Log[1].Stage = "free 2"; },
    [](SolverState& s) { s.Fields.Vortices[0].Strength += 1.0; },
    [](SolverState& s) { s.Fields.Wind.Knots[0][1] = 0.0f; },
    [](SolverState& s) { s.Part[5] = 6.0f; },
    [](SolverState& s) { s.Curvature.Pairs.Y[0][2] = 6.0f; },
    [](SolverState& s) { s.Curvature.Gamma = 2.0; },
    [](SolverState& s) { s.Sweep.Index = 1; }
  };
  for (std::size_t k = 0; k < changes.size(); ++k)
  {
    SolverState changed = back;
    changes[k](changed);
    EXPECT_NE(BytesOf(changed), bytes) << k;
  }
}

TEST(Checkpoint, OneOfSomethingElseIsIgnoredAndSaidSo)
{
  const SpacetimeInput input = Scene();
  const std::string path = CheckpointPath("other");
  SpacetimeOptions few = Options(path);
  few.MaximumNumberOfIterations = 6;
  few.LeashIterations = 2;
  const auto leave = [&](double fraction)
  {
    At monitor(fraction);
    SpacetimeOutput output;
    ASSERT_TRUE(RunSpacetime(input, few, SerialFor(), monitor, output).IsStopped());
    ASSERT_TRUE(FileExists(path));
  };
  const auto anew = [](const SpacetimeInput& given, SpacetimeOptions options)
  {
    options.CheckpointFile.clear();
    return RunScene(given, options);
  };
  const auto expectIgnored = [](const SpacetimeInput& given, const SpacetimeOptions& options,
                                const char* reason, const SpacetimeOutput& wanted)
  {
    const SpacetimeOutput output = RunScene(given, options);
    ASSERT_EQ(output.Warnings.size(), 1u) << reason;
    EXPECT_NE(output.Warnings[0].find(reason), std::string::npos) << output.Warnings[0];
    ExpectSameMotion(output, wanted);
  };
  const SpacetimeOutput whole = anew(input, few);
  leave(0.3);
  SpacetimeOptions options = few;
  options.CoherenceWeight = 0.5;
  expectIgnored(input, options, "other inputs or properties", anew(input, options));
  leave(0.3);
  SpacetimeInput moved = input;
  moved.Tracks[1].Positions[20].x() += 1e-12;
  expectIgnored(moved, few, "other inputs or properties", anew(moved, few));
  leave(0.3);
  {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(5000);
    file.put('x');
  }
  expectIgnored(input, few, "damaged", whole);
  leave(0.3);
  ASSERT_EQ(::truncate(path.c_str(), 3000), 0);
  expectIgnored(input, few, "damaged", whole);
  {
    StateFileWriter file(path, { "spacetime checkpoint", 11 }, DigestOfRun(input, few));
    const std::uint64_t none = 0;
    file.Values(none, none);
    ASSERT_TRUE(file.Commit());
  }
  expectIgnored(input, few, "incomplete", whole);
}

TEST(Checkpoint, OneThatCannotBeWrittenIsAWarning)
{
  SpacetimeOptions options = Options("/nonexistent/folder/checkpoint");
  options.MaximumNumberOfIterations = 3;
  const SpacetimeOutput output = RunScene(Scene(), options);
  ASSERT_EQ(output.Warnings.size(), 1u);
  EXPECT_NE(output.Warnings[0].find("cannot write /nonexistent/folder/checkpoint"),
            std::string::npos);
}
