// SPDX-License-Identifier: BSD-3-Clause
// A motion database from nothing: simulations of random air, traced, cut, compressed, clustered
// (Shi et al. 2005, section 3).
#pragma once

#include "Base/Monitor.h"
#include "Base/Parallel.h"
#include "Base/Result.h"
#include "Grid/SmokeEnsemble.h"
#include "Grid/SmokeOptions.h"
#include "Trajectory/TrajectoryClusters.h"
#include "Trajectory/TrajectoryTracer.h"

#include <cstdint>

namespace waft
{

/// The parts' own volume, frame rate, warm-up, settling speed and seed are not read: the ones here
/// hold for all of them.
struct DatabaseOptions
{
  int NumberOfSimulations = 8;
  int NumberOfFrames = 300;
  double FramesPerSecond = 30.0;
  Box Bounds;
  /// Voxels along the longest side of Bounds; they are cubes, so that the other sides must hold a
  /// whole number of them.
  int Resolution = 64;
  /// The air is driven for this long before tracers are set free [s].
  double WarmUpSeconds = 3.0;
  /// With which the tracers sink [m/s].
  double SettlingSpeed = 0.0;
  std::uint64_t Seed = 1;
  /// Runs advanced side by side: memory grows with it, results do not depend on it.
  int SimulationsAtOnce = 4;

  EnsembleOptions Ensemble;
  SmokeOptions Smoke;
  TraceOptions Trace;
  ClusterOptions Cluster;

  DatabaseOptions();
  Result Validate() const;
};

/// One thread a simulation, two frames in memory each. The same options give the same database bit
/// by bit, whatever the number of threads. Provenance lists the parameters. When it is stopped, the
/// database is that of the first simulations that are whole, untouched when there is none.
Result BuildDatabase(const DatabaseOptions& options, const ParallelFor& parallelFor,
                     Monitor& monitor, MotionDatabase& database);

/// The seed of one of its simulations.
std::uint64_t SimulationSeed(std::uint64_t seed, int simulation);

} // namespace waft
