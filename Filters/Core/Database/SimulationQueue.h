// SPDX-License-Identifier: BSD-3-Clause
// Simulations side by side, one thread each.
#pragma once

#include "Base/Monitor.h"
#include "Base/Parallel.h"
#include "Base/Result.h"
#include "Database/DatabaseBuild.h"
#include "Database/SimulationRun.h"
#include "Database/TracedFiles.h"

#include <map>
#include <memory>
#include <vector>

namespace waft
{

/// Hands out the simulations of a database in their order, while as many as SimulationsAtOnce
/// advance; when one ends, the next one takes its place.
class SimulationQueue
{
public:
  /// Simulations that the files hold are taken from there, others are written when they are whole.
  SimulationQueue(const DatabaseOptions& options, const TracedFiles& files);

  /// The next simulation in order. Stopped by the monitor within a frame of the air, whatever the
  /// number of simulations at once; those that were whole by then are in the files. `monitor` is
  /// asked from the calling thread only; its fraction is of all simulations.
  Result Next(const ParallelFor& parallelFor, Monitor& monitor, TracedSimulation& traced);

private:
  struct Slot
  {
    int Simulation = 0;
    int StepsTaken = 0;
    std::unique_ptr<SimulationRun> Run;
    Result Outcome = Result::Ok();
  };
  Result FillSlots();
  /// Every slot for a short time.
  Result Advance(const ParallelFor& parallelFor, Monitor& monitor);
  Result Gather();

  const DatabaseOptions& Options;
  const TracedFiles& Files;
  std::vector<Slot> Slots;
  std::map<int, TracedSimulation> Whole; // not yet handed out
  int Started = 0;                       // simulations that are in slots or behind them
  int HandedOut = 0;
  bool IsStopped = false; // only what is whole is handed out then
  long StepsDone = 0;     // of simulations that are whole
};

} // namespace waft
