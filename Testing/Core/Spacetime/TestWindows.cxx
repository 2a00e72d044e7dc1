// SPDX-License-Identifier: BSD-3-Clause
// Runs in bounded memory.
#include "Spacetime/Run/SpacetimeBudget.h"
#include "Spacetime/Scene/SpacetimeSetup.h"
#include "SpacetimeRuns.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include <sys/wait.h>
#include <unistd.h>

using namespace waft;

namespace
{

SpacetimeInput Scene(int frames, int objects)
{
  SceneOptions scene;
  scene.NumberOfFrames = frames;
  scene.NumberOfObjects = objects;
  return MakeScene(scene);
}

SpacetimeBudget BudgetOf(const SpacetimeInput& input, const SpacetimeOptions& options)
{
  SpacetimeSetup setup;
  EXPECT_TRUE(MakeSetup(input, options, setup));
  return SpacetimeBudget(setup.Model, options);
}

/// A field of /proc/self/status [MB].
double StatusMegabytes(const std::string& name)
{
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
  {
    if (line.compare(0, name.size(), name) == 0)
    {
      return std::stod(line.substr(name.size() + 1)) * 1024e-6;
    }
  }
  return 0.0;
}

/// What a run adds to the memory of a process of its own at most [MB].
double MeasurePeak(const SpacetimeInput& input, const SpacetimeOptions& options)
{
  int ends[2];
  EXPECT_EQ(::pipe(ends), 0);
  const pid_t child = ::fork();
  if (child == 0)
  {
    std::ofstream("/proc/self/clear_refs") << "5"; // the peak is from now on
    const double before = StatusMegabytes("VmRSS:");
    SilentMonitor monitor;
    SpacetimeOutput output;
    double peak = -1.0;
    if (RunSpacetime(input, options, SerialFor(), monitor, output))
    {
      peak = StatusMegabytes("VmHWM:") - before;
    }
    const bool written = ::write(ends[1], &peak, sizeof(peak)) == sizeof(peak);
    ::_exit(written ? 0 : 1);
  }
  double peak = -1.0;
  EXPECT_EQ(::read(ends[0], &peak, sizeof(peak)), static_cast<ssize_t>(sizeof(peak)));
  int status = 0;
  ::waitpid(child, &status, 0);
  ::close(ends[0]);
  ::close(ends[1]);
  return peak;
}

} // namespace

TEST(Windows, AreAskedForByTheirLengthAsByAMemoryLimit)
{
  const SpacetimeInput input = Scene(40, 2);
  SpacetimeOptions options = QuickOptions();
  options.NumberOfGasParticles = 125;
  options.MemoryLimit = 1.00001e-6 * BudgetOf(input, options).Of(16);
  const SpacetimeOutput limited = RunScene(input, options);
  ASSERT_EQ(BudgetOf(input, options).WindowOf(40, options.MemoryLimit), 12u);
  options.MemoryLimit = 0.0;
  options.WindowLength = 12;
  EXPECT_EQ(BudgetOf(input, options).WindowOf(40, 0.0), 12u);
  EXPECT_EQ(BudgetOf(input, options).WindowOf(10, 0.0), 10u);
  ExpectSameMotion(RunScene(input, options), limited);
  // Long windows are cut to what memory there is.
  options.WindowLength = 30;
  EXPECT_EQ(BudgetOf(input, options).WindowOf(40, 1.00001e-6 * BudgetOf(input, options).Of(16)),
            12u);
  options.WindowLength = 3;
  SilentMonitor monitor;
  SpacetimeOutput output;
  EXPECT_NE(RunSpacetime(input, options, SerialFor(), monitor, output)
              .Message()
              .find("WindowLength: expected 0 or 8 frames at least"),
            std::string::npos);
}

TEST(Windows, EndWithinFivePercentOfAllAtOnce)
{
  const SpacetimeInput input = Scene(60, 4);
  SpacetimeOptions options = QuickOptions();
  options.NumberOfGasParticles = 125;
  options.LeashIterations = 20;
  options.MaximumNumberOfIterations = 120;
  options.Tolerance = 0.005;
  const SpacetimeOutput whole = RunScene(input, options);
  const SpacetimeBudget budget = BudgetOf(input, options);
  options.MemoryLimit = 1e-6 * budget.Of(26);
  EXPECT_NEAR(double(budget.WindowOf(60, options.MemoryLimit)), 22.0, 1.0);
  const SpacetimeOutput windowed = RunScene(input, options);
  RecordProperty("whole", std::to_string(whole.Convergence.back().E));
  RecordProperty("windowed", std::to_string(windowed.Convergence.back().E));
  RecordProperty("seconds", std::to_string(whole.Convergence.back().Seconds) + " " +
                              std::to_string(windowed.Convergence.back().Seconds));
  EXPECT_LT(windowed.Convergence.back().E, 1.05 * whole.Convergence.back().E);
  for (std::size_t k = 1; k < windowed.Convergence.size(); ++k)
  {
    const ConvergenceRow& row = windowed.Convergence[k];
    const ConvergenceRow& before = windowed.Convergence[k - 1];
    if (before.Stage == row.Stage)
    {
      EXPECT_LE(row.E, before.E) << row.Stage << " " << row.Iteration;
    }
  }
  for (const ReportRow& row : windowed.Report)
  {
    EXPECT_EQ(row.Status, ConstraintStatus::Met);
  }
}

TEST(Windows, SumUpToTheEnergyOfTheWhole)
{
  const SpacetimeInput input = Scene(60, 3);
  SpacetimeOptions options = QuickOptions();
  options.MaximumNumberOfIterations = 8;
  options.LeashIterations = 4;
  options.MemoryLimit = 1e-6 * BudgetOf(input, options).Of(24);
  options.EstimateWind = false;
  options.FitVortexFields = false;
  const SpacetimeOutput whole = RunScene(input, options);
  // The sum of what the windows gain is E as it is measured on the whole when a stage begins.
  int stages = 0;
  for (std::size_t k = 3; k + 1 < whole.Convergence.size(); ++k)
  {
    const ConvergenceRow& row = whole.Convergence[k];
    const ConvergenceRow& before = whole.Convergence[k - 1];
    const bool isNewLevel = row.Stage == "free 1, coarse a" || row.Stage == "fine a";
    if (row.Stage != before.Stage && !isNewLevel)
    {
      EXPECT_NEAR(row.E, before.E, 1e-4 * before.E) << row.Stage;
      ++stages;
    }
  }
  EXPECT_EQ(stages, 9);
}

TEST(Windows, TheBudgetIsWhatIsMeasured)
{
  const SpacetimeInput input = Scene(80, 5);
  SpacetimeOptions options = QuickOptions();
  options.NumberOfGasParticles = 729;
  options.UseLeash = false;
  options.Passes = 1;
  options.Tolerance = 0.0;
  options.MaximumNumberOfIterations = 24; // the histories are full
  const SpacetimeBudget budget = BudgetOf(input, options);
  const double expected = 1e-6 * budget.Of(80);
  const double measured = MeasurePeak(input, options);
  RecordProperty("expected", std::to_string(expected));
  RecordProperty("measured", std::to_string(measured));
  EXPECT_LT(measured, 1.05 * expected);
  EXPECT_GT(measured, 0.7 * expected);

  options.MemoryLimit = 0.7 * expected;
  options.MaximumNumberOfIterations = 4;
  const double limited = MeasurePeak(input, options);
  RecordProperty("limited", std::to_string(limited));
  EXPECT_LT(limited, options.MemoryLimit);
  EXPECT_GT(limited, 0.5 * options.MemoryLimit);
}

TEST(Windows, ARunThatNoMachineHoldsIsRefusedByItsSizes)
{
  const Box room{ Vec3(-2, -2, 0), Vec3(2, 2, 4) };
  SpacetimeOptions options;
  EXPECT_TRUE(CheckRoom(room, 300, 125, options));
  const std::string huge = CheckRoom(room, 1000000, 10000, options).Message();
  EXPECT_NE(huge.find("1000000 frames of so many particles take"), std::string::npos) << huge;
  options.MemoryLimit = 1e9; // window by window
  EXPECT_TRUE(CheckRoom(room, 1000000, 1, options));
  const Box flat{ Vec3(-5, -5, 0), Vec3(5, 5, 0.1) };
  const std::string thin = CheckRoom(flat, 300, 1, options).Message();
  EXPECT_NE(thin.find("Bounds: too flat for its gas, which is 62 x 62 x 1"), std::string::npos)
    << thin;
}

TEST(Windows, ALimitThatIsTooLowSaysHowMuchItTakes)
{
  const SpacetimeInput input = Scene(40, 3);
  SpacetimeOptions options = QuickOptions();
  options.NumberOfGasParticles = 125;
  options.MemoryLimit = 1.0;
  SilentMonitor monitor;
  SpacetimeOutput output;
  const Result result = RunSpacetime(input, options, SerialFor(), monitor, output);
  ASSERT_FALSE(result);
  EXPECT_NE(result.Message().find("MemoryLimit: 1 MB, at least"), std::string::npos)
    << result.Message();
  EXPECT_TRUE(output.Tracks.empty());
  // And that much is enough.
  options.MaximumNumberOfIterations = 2;
  options.LeashIterations = 1;
  options.MemoryLimit = std::stod(result.Message().substr(result.Message().find("least ") + 6));
  EXPECT_EQ(RunScene(input, options).Tracks.size(), 3u);
}
