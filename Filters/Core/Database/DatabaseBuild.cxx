// SPDX-License-Identifier: BSD-3-Clause
#include "Database/DatabaseBuild.h"

#include "Base/Random.h"
#include "Database/Provenance.h"
#include "Database/SimulationQueue.h"
#include "Database/SimulationRun.h"
#include "Database/TracedFiles.h"

#include <cmath>

namespace waft
{

namespace
{

constexpr double SimulationFraction = 0.95; // of the progress; the rest is cutting and clustering

/// The part of the progress that simulations make.
class SimulationMonitor : public Monitor
{
public:
  explicit SimulationMonitor(Monitor& whole) : Whole(whole) {}
  bool Tick(double fraction, const std::string& text) override
  {
    return this->Whole.Tick(SimulationFraction * fraction, text);
  }

private:
  Monitor& Whole;
};

/// Reports how far it is and goes on: what the simulations took minutes for is clustered in
/// seconds, and without that there is nothing to show for them.
class ToTheEnd : public Monitor
{
public:
  explicit ToTheEnd(Monitor& whole) : Whole(whole) {}
  bool Tick(double fraction, const std::string& text) override
  {
    const double part = SimulationFraction + (1.0 - SimulationFraction) * fraction;
    this->IsAsked = this->IsAsked && this->Whole.Tick(part, text);
    return true;
  }

private:
  Monitor& Whole;
  bool IsAsked = true; // until it says stop
};

/// Runs and measures one simulation after the other; `traced` gets those that are whole, when it is
/// stopped, too.
Result Simulate(const DatabaseOptions& options, Communicator& ranks, const ParallelFor& parallelFor,
                Monitor& monitor, std::vector<TracedSimulation>& traced, Coverage& coverage)
{
  const TracedFiles files(options.KeptIn, SimulationText(options));
  SimulationQueue queue(options, files, ranks);
  while (static_cast<int>(traced.size()) < options.NumberOfSimulations)
  {
    TracedSimulation next;
    const Result result = queue.Next(parallelFor, monitor, next);
    if (!result || result.IsStopped())
    {
      return result;
    }
    traced.push_back(std::move(next));
    coverage.Add(traced.back().Tracks, parallelFor);
    if (!coverage.Curve().empty() && coverage.Curve().back().NewShare < options.StopBelow)
    {
      break;
    }
  }
  return Result::Ok();
}

} // namespace

DatabaseOptions::DatabaseOptions()
{
  // So that the median speed of the tracers is near 0.6 m/s and one in twenty samples is faster
  // than 1.3 m/s, in the default volume.
  this->Ensemble.VortexAcceleration = { 0.27, 1.05 };
  this->Ensemble.WindAcceleration = { 0.16, 0.65 };
  this->Ensemble.NumberOfEmitters = 0; // nobody sees this smoke
  this->Smoke.BuoyancyTemperature = 0.0;
}

Result DatabaseOptions::Validate() const
{
  WAFT_RETURN_IF_FAILED(this->ValidateRun());
  WAFT_RETURN_IF_FAILED(ValidateFields<DatabaseOptions>(*this));
  if (this->SimulationsAtOnce < 1)
  {
    return Result::Error("SimulationsAtOnce: expected at least 1");
  }
  WAFT_RETURN_IF_FAILED(this->Trace.Validate());
  return this->Cluster.Validate();
}

std::uint64_t SimulationSeed(std::uint64_t seed, int simulation)
{
  Random random(seed, 1000 + static_cast<std::uint64_t>(simulation));
  const std::uint64_t high = random.Bits() >> 11; // 53 bits: exact in a double, too
  return (high << 32) | random.Bits();
}

Result BuildDatabase(const DatabaseOptions& options, const ParallelFor& parallelFor,
                     Monitor& monitor, MotionDatabase& database,
                     std::vector<CoveragePoint>& coverage)
{
  SingleRank alone;
  return BuildDatabase(options, alone, parallelFor, monitor, database, coverage);
}

Result BuildDatabase(const DatabaseOptions& options, Communicator& ranks,
                     const ParallelFor& parallelFor, Monitor& monitor, MotionDatabase& database,
                     std::vector<CoveragePoint>& coverage)
{
  WAFT_RETURN_IF_FAILED(options.Validate());
  SmokeOptions smoke;
  WAFT_RETURN_IF_FAILED(SmokeOptionsOf(options, smoke));

  ClusterInput traced;
  traced.FramesPerSecond = options.FramesPerSecond;
  traced.Volume = options.Bounds;
  traced.SettlingSpeed = options.SettlingSpeed;
  Coverage measured(options.Cluster.Segmentation, options.FramesPerSecond, options.Bounds.Width(),
                    options.CoverageTolerance);
  SimulationMonitor simulating(monitor);
  const Result simulated =
    Simulate(options, ranks, parallelFor, simulating, traced.Simulations, measured);
  if (!simulated || (simulated.IsStopped() && traced.Simulations.empty()))
  {
    return simulated;
  }

  DatabaseOptions whole = options;
  whole.NumberOfSimulations = static_cast<int>(traced.Simulations.size());
  whole.Cluster.Trees.Seed = options.Seed;
  ToTheEnd clustering(monitor);
  SilentMonitor silent; // of a stop it was told already
  MotionDatabase result;
  WAFT_RETURN_IF_FAILED(ClusterTrajectories(
    traced, whole.Cluster, parallelFor,
    simulated.IsStopped() ? static_cast<Monitor&>(silent) : clustering, result));
  result.Provenance = ProvenanceOf(whole);
  database = std::move(result);
  coverage = measured.Curve();
  return simulated;
}

} // namespace waft
