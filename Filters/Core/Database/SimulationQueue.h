// SPDX-License-Identifier: BSD-3-Clause
// Simulations by all ranks, side by side on each of them.
#pragma once

#include "Base/Monitor.h"
#include "Base/Parallel.h"
#include "Base/Result.h"
#include "Base/SharedWork.h"
#include "Database/DatabaseBuild.h"
#include "Database/SimulationSlots.h"
#include "Database/TracedFiles.h"

#include <cstdint>
#include <map>

namespace waft
{

/// Hands out the simulations of a database in their order, while as many as SimulationsAtOnce
/// advance on each rank; when one ends, the next one takes its place.
class SimulationQueue
{
public:
  /// Simulations that the files hold are taken from there, others are written when they are whole;
  /// by this rank, the first, alone.
  SimulationQueue(const DatabaseOptions& options, const TracedFiles& files, Communicator& ranks);

  /// The next simulation in order. Stopped by the monitor within a frame of the air, whatever the
  /// number of simulations at once; those that were whole by then are in the files. `monitor` is
  /// asked from the calling thread only; its fraction is of all simulations.
  Result Next(const ParallelFor& parallelFor, Monitor& monitor, TracedSimulation& traced);

private:
  /// The next simulation that is to be begun; below 0: none now.
  std::int64_t Start();
  Result Keep(std::int64_t simulation, TracedSimulation traced);
  /// Every simulation for a short time.
  Result Advance(const ParallelFor& parallelFor, Monitor& monitor);

  const DatabaseOptions& Options;
  const TracedFiles& Files;
  const std::size_t MostWaiting;
  WorkSharing Others;
  SimulationSlots Slots;
  std::map<std::int64_t, TracedSimulation> Whole; // not yet handed out
  int Started = 0;                                // simulations that are in slots or behind them
  int HandedOut = 0;
  bool IsStopped = false; // only what is whole is handed out then
  long StepsDone = 0;     // of simulations that are whole
};

} // namespace waft
