// SPDX-License-Identifier: BSD-3-Clause
// Simulations side by side, one thread each.
#pragma once

#include "Base/Monitor.h"
#include "Base/Parallel.h"
#include "Base/Result.h"
#include "Database/DatabaseBuild.h"
#include "Database/SimulationRun.h"

#include <map>
#include <memory>
#include <vector>

namespace waft
{

/// As many as SimulationsAtOnce advance by short turns; when one is whole there is room for
/// another.
class SimulationSlots
{
public:
  explicit SimulationSlots(const DatabaseOptions& options) : Options(options) {}

  bool IsEmpty() const { return this->Slots.empty(); }
  bool HasRoom() const;
  Result Begin(int simulation);
  /// Every one for a short time. Stopped by the monitor within a frame of the air, whatever the
  /// number of simulations. `monitor` is asked from the calling thread only; its fraction is of
  /// all simulations, of which so many frames are done elsewhere.
  Result Advance(long stepsElsewhere, const ParallelFor& parallelFor, Monitor& monitor);
  /// Those that are whole, which leave.
  std::map<int, TracedSimulation> TakeWhole();

private:
  struct Slot
  {
    int Simulation = 0;
    int StepsTaken = 0;
    std::unique_ptr<SimulationRun> Run;
    Result Outcome = Result::Ok();
  };

  const DatabaseOptions& Options;
  std::vector<Slot> Slots;
};

} // namespace waft
