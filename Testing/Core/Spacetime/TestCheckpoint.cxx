// SPDX-License-Identifier: BSD-3-Clause
// Runs that are killed, and go on.
#include "SpacetimeRuns.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <fstream>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

using namespace waft;

namespace
{

std::string CheckpointPath(const char* name)
{
  std::string path = testing::TempDir() + "waft-checkpoint-" + name;
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
  options.MaximumNumberOfIterations = 30;
  options.CheckpointFile = path;
  options.CheckpointInterval = 0.0;
  return options;
}

bool Exists(const std::string& path)
{
  return std::ifstream(path).good();
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
    ASSERT_TRUE(Exists(path)) << fraction;
    FirstTick monitor;
    SpacetimeOutput output;
    ASSERT_TRUE(RunSpacetime(input, Options(path), ThreadedFor(2), monitor, output));
    EXPECT_GT(monitor.First, 0.9 * fraction); // it goes on, not over it all again
    EXPECT_TRUE(output.Warnings.empty());
    ExpectSameMotion(output, whole);
    EXPECT_FALSE(Exists(path)); // removed when it is done
  }
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
  for (double share = 0.3; share > 0.01 && !Exists(path); share *= 0.5)
  {
    limited.TimeLimit = share * whole.Convergence.back().Seconds;
    cut = RunScene(input, limited);
  }
  ASSERT_EQ(cut.Warnings.size(), 1u);
  ASSERT_TRUE(Exists(path));
  ExpectSameMotion(RunScene(input, Options(path)), whole);
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
    ASSERT_TRUE(Exists(path));
  };
  const auto expectIgnored =
    [&](const SpacetimeInput& given, SpacetimeOptions options, const char* reason)
  {
    const SpacetimeOutput output = RunScene(given, options);
    ASSERT_EQ(output.Warnings.size(), 1u) << reason;
    EXPECT_NE(output.Warnings[0].find(reason), std::string::npos) << output.Warnings[0];
    options.CheckpointFile.clear();
    ExpectSameMotion(output, RunScene(given, options));
  };
  leave(0.3);
  SpacetimeOptions options = few;
  options.CoherenceWeight = 0.5;
  expectIgnored(input, options, "other inputs or properties");
  leave(0.3);
  SpacetimeInput moved = input;
  moved.Tracks[1].Positions[20].x() += 1e-12;
  expectIgnored(moved, few, "other inputs or properties");
  leave(0.3);
  {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(5000);
    file.put('x');
  }
  expectIgnored(input, few, "damaged");
  leave(0.3);
  ASSERT_EQ(::truncate(path.c_str(), 3000), 0);
  expectIgnored(input, few, "damaged");
  {
    StateFileWriter file(path);
    std::string format = "Waft spacetime checkpoint 2";
    std::uint64_t key = DigestOfRun(input, few);
    std::uint64_t none = 0;
    file.Text(format);
    file.Values(key, none, none);
    ASSERT_TRUE(file.Commit());
  }
  expectIgnored(input, few, "incomplete");
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
