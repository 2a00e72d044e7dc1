// SPDX-License-Identifier: BSD-3-Clause
// One random simulation, traced while it runs.
#pragma once

#include "Base/Monitor.h"
#include "Base/Result.h"
#include "Database/DatabaseBuild.h"
#include "Grid/SmokeSolver.h"
#include "Obstacles/DistanceLattice.h"
#include "Trajectory/TrajectoryClusters.h"
#include "Trajectory/TrajectoryTracer.h"

#include <memory>

namespace waft
{

/// Begin, then Step StepsOfSimulation times, then Finish. Steps of different runs may be taken from
/// different threads at once.
class SimulationRun
{
public:
  Result Begin(const DatabaseOptions& options, int simulation);
  /// One frame of air; after the warm-up the tracers move with it. Serial. Stopped by the monitor
  /// it is where it was before.
  Result Step(Monitor& monitor);
  /// Its tracks have all that becomes part of a database: no VortexAccelerations.
  TracedSimulation Finish();

private:
  Result PositionObstacles(const SmokeOptions& options, const std::vector<ObstacleMesh>& obstacles);

  int WarmUpFrames = 0;
  int StepsTaken = 0;
  double StartTime = 0.0; // of the tracers, in the solver's time [s]
  SmokeSolver Solver;
  SmokeFrame Fields;
  TrajectoryTracer Tracer;
  std::vector<Vortex> Vortices; // in the tracers' time
  std::shared_ptr<DistanceLattice> Distances;
};

/// Frames of the warm-up and of the run.
int StepsOfSimulation(const DatabaseOptions& options);

/// The parameters of the smoke that DatabaseOptions stand for.
Result SmokeOptionsOf(const DatabaseOptions& options, SmokeOptions& smoke);

} // namespace waft
