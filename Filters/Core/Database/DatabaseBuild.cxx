// SPDX-License-Identifier: BSD-3-Clause
#include "Database/DatabaseBuild.h"

#include "Base/Random.h"
#include "Database/Provenance.h"
#include "Database/SimulationRun.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace waft
{

namespace
{

constexpr double SimulationShare = 0.95; // of the progress; the rest is cutting and clustering

/// Advances some runs to their end, all by one frame at a time, so that the caller's monitor is
/// asked between frames.
Result Advance(std::vector<std::unique_ptr<SimulationRun>>& runs, int first, int all,
               const ParallelFor& parallelFor, Monitor& monitor)
{
  const int steps = runs.front()->NumberOfSteps();
  const int last = first + static_cast<int>(runs.size());
  const std::string who = "Simulations " + std::to_string(first + 1) + " to " +
                          std::to_string(last) + " of " + std::to_string(all);
  for (int step = 0; step < steps; ++step)
  {
    const double done = first + double(step) / steps * (last - first);
    if (!monitor.Tick(SimulationShare * done / all,
                      who + ", frame " + std::to_string(step + 1) + " of " + std::to_string(steps)))
    {
      return Result::Stopped();
    }
    std::vector<Result> results(runs.size(), Result::Ok());
    parallelFor(runs.size(),
                [&](std::size_t begin, std::size_t end)
                {
                  for (std::size_t r = begin; r < end; ++r)
                  {
                    SilentMonitor silent;
                    results[r] = runs[r]->Step(silent);
                  }
                });
    for (std::size_t r = 0; r < runs.size(); ++r)
    {
      if (!results[r])
      {
        return Result::Error("simulation " + std::to_string(first + r) + ": " +
                             results[r].Message());
      }
    }
  }
  return Result::Ok();
}

/// Runs in batches; `traced` gets those that are whole, when it is stopped, too.
Result Simulate(const DatabaseOptions& options, const ParallelFor& parallelFor, Monitor& monitor,
                std::vector<TracedSimulation>& traced)
{
  for (int first = 0; first < options.NumberOfSimulations; first += options.SimulationsAtOnce)
  {
    const int last = std::min(first + options.SimulationsAtOnce, options.NumberOfSimulations);
    std::vector<std::unique_ptr<SimulationRun>> runs;
    for (int simulation = first; simulation < last; ++simulation)
    {
      runs.push_back(std::make_unique<SimulationRun>());
      if (Result begun = runs.back()->Begin(options, simulation); !begun)
      {
        return Result::Error("simulation " + std::to_string(simulation) + ": " + begun.Message());
      }
    }
    const Result advanced = Advance(runs, first, options.NumberOfSimulations, parallelFor, monitor);
    if (!advanced || advanced.IsStopped())
    {
      return advanced;
    }
    for (const std::unique_ptr<SimulationRun>& run : runs)
    {
      traced.push_back(run->Finish());
    }
  }
  return Result::Ok();
}

class LastPart : public Monitor
{
public:
  explicit LastPart(Monitor& whole) : Whole(whole) {}
  bool Tick(double fraction, const std::string& text) override
  {
    return this->Whole.Tick(SimulationShare + (1.0 - SimulationShare) * fraction, text);
  }

private:
  Monitor& Whole;
};

} // namespace

DatabaseOptions::DatabaseOptions()
{
  // So that the median speed of the tracers is near 0.6 m/s and one in twenty samples is faster
  // than 1.3 m/s, in the default volume.
  this->Ensemble.VortexAcceleration = { 0.27, 1.05 };
  this->Ensemble.WindAcceleration = { 0.16, 0.65 };
  this->Ensemble.NumberOfEmitters = 0; // nobody sees this smoke
}

Result DatabaseOptions::Validate() const
{
  if (this->NumberOfSimulations < 1 || this->NumberOfFrames < 2 || this->SimulationsAtOnce < 1)
  {
    return Result::Error(
      "NumberOfSimulations, NumberOfFrames, SimulationsAtOnce: expected at least "
      "1, 2 and 1");
  }
  if (!(this->FramesPerSecond > 0.0) || !std::isfinite(this->FramesPerSecond))
  {
    return Result::Error("FramesPerSecond: expected a positive number");
  }
  if (!(this->Bounds.Size().minCoeff() > 0.0) || !this->Bounds.Size().allFinite())
  {
    return Result::Error("Bounds: expected a box with positive sides");
  }
  if (this->Resolution < 4 || this->Resolution > 1024)
  {
    return Result::Error("Resolution: expected 4 to 1024 voxels");
  }
  if (!(this->WarmUpSeconds >= 0.0) || !(this->WarmUpSeconds < 1e4))
  {
    return Result::Error("WarmUpSeconds: expected a number of at least 0");
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
                     Monitor& monitor, MotionDatabase& database)
{
  WAFT_RETURN_IF_FAILED(options.Validate());
  SmokeOptions smoke;
  WAFT_RETURN_IF_FAILED(SmokeOptionsOf(options, smoke));

  ClusterInput traced;
  traced.FramesPerSecond = options.FramesPerSecond;
  traced.Volume = options.Bounds;
  traced.SettlingSpeed = options.SettlingSpeed;
  const Result simulated = Simulate(options, parallelFor, monitor, traced.Simulations);
  if (!simulated || (simulated.IsStopped() && traced.Simulations.empty()))
  {
    return simulated;
  }

  DatabaseOptions whole = options;
  whole.NumberOfSimulations = static_cast<int>(traced.Simulations.size());
  whole.Cluster.Trees.Seed = options.Seed;
  LastPart clustering(monitor);
  SilentMonitor silent; // of a stop it was told already
  MotionDatabase result;
  const Result clustered =
    ClusterTrajectories(traced, whole.Cluster, parallelFor,
                        simulated.IsStopped() ? static_cast<Monitor&>(silent) : clustering, result);
  if (!clustered || clustered.IsStopped())
  {
    return clustered;
  }
  result.Provenance = ProvenanceOf(whole);
  database = std::move(result);
  return simulated;
}

} // namespace waft
