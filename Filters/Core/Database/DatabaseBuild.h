// SPDX-License-Identifier: BSD-3-Clause
// A motion database from nothing: simulations of random air, traced, cut, compressed, clustered
// (Shi et al. 2005, section 3).
#pragma once

#include "Base/Monitor.h"
#include "Base/Parallel.h"
#include "Base/Result.h"
#include "Grid/SmokeEnsemble.h"
#include "Grid/SmokeOptions.h"
#include "Trajectory/Coverage.h"
#include "Trajectory/TrajectoryClusters.h"
#include "Trajectory/TrajectoryTracer.h"

#include <cstdint>
#include <string>
#include <vector>

namespace waft
{

/// The parts' own volume, frame rate, warm-up, settling speed and seed are not read: the ones here
/// hold for all of them.
struct DatabaseOptions
{
  int NumberOfSimulations = 8; // at most, when StopBelow is set
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
  /// The first simulation of whose segments a smaller share than this is new is the last (Coverage;
  /// Shi et al. 2005 stop when no new shapes are seen); 0: all are run.
  double StopBelow = 0.0;
  /// A segment is new when its rms distance to all before is above this share of the rms chord.
  double CoverageTolerance = Coverage::DefaultTolerance;
  /// Simulations that are whole are kept in this folder, and taken from it when a run of the same
  /// parameters left them there; empty: nothing is kept. The folder may be removed afterwards.
  std::string KeptIn;

  EnsembleOptions Ensemble;
  SmokeOptions Smoke;
  TraceOptions Trace;
  ClusterOptions Cluster;

  DatabaseOptions();
  Result Validate() const;
};

/// One thread a simulation, two frames in memory each. The same options give the same database bit
/// by bit, whatever the number of threads. Provenance lists the parameters. When it is stopped, the
/// database is that of the first simulations that are whole, untouched when there is none (cutting
/// and clustering them takes some seconds more); called again with the same KeptIn it goes on with
/// those that follow. coverage: what each simulation but the first brought.
Result BuildDatabase(const DatabaseOptions& options, const ParallelFor& parallelFor,
                     Monitor& monitor, MotionDatabase& database,
                     std::vector<CoveragePoint>& coverage);

/// The seed of one of its simulations.
std::uint64_t SimulationSeed(std::uint64_t seed, int simulation);

} // namespace waft
