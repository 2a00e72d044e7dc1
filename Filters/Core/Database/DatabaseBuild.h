// SPDX-License-Identifier: BSD-3-Clause
// A motion database from nothing: simulations of random air, traced, cut, compressed, clustered
// (Shi et al. 2005, section 3).
#pragma once

#include "Base/Monitor.h"
#include "Base/Parallel.h"
#include "Base/Result.h"
#include "Base/SceneFrame.h"
#include "Base/SharedWork.h"
#include "Grid/SmokeEnsemble.h"
#include "Grid/SmokeOptions.h"
#include "Trajectory/Coverage.h"
#include "Trajectory/TrajectoryClusters.h"
#include "Trajectory/TrajectoryTracer.h"

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace waft
{

/// The parts' own run, settling speed and seed are not read: the ones here hold for all of them.
struct DatabaseOptions : AirRun
{
  int NumberOfSimulations = 8;
  int NumberOfFrames = 300;
  int Resolution = 64;
  double SettlingSpeed = 0.0;
  std::uint64_t Seed = 1;
  /// Runs advanced side by side: memory grows with it, results do not depend on it.
  int SimulationsAtOnce = 4;
  double StopBelow = 0.0; // Coverage; Shi et al. 2005 stop when no new shapes are seen
  double CoverageTolerance = Coverage::DefaultTolerance;
  std::string KeptIn;

  EnsembleOptions Ensemble;
  SmokeOptions Smoke;
  TraceOptions Trace;
  ClusterOptions Cluster;

  DatabaseOptions();
  Result Validate() const;

  /// Of what a user sets, all that a simulation of a given index depends on. The parts' fields are
  /// found in the parts, those of any other holder in itself.
  template <class Visitor, class... Holder>
  static void VisitSimulations(Visitor&& visit, Holder&... of)
  {
    AirRun::Visit(visit, of...);
    visit(NumberOfFramesField(2), of.NumberOfFrames...);
    visit(
      OptionField{
        "Resolution",
        { 4, 1024 },
        "",
        "Voxels along the longest side of the volume, whose sides are whole numbers of them." },
      of.Resolution...);
    visit(SeedField(), of.Seed...);
    visit(
      OptionField{
        "SettlingSpeed", limits::UpTo(limits::Speed.High), "m/s",
        "Tracers sink through the air at this speed, in metres per second; 0: they follow it." },
      of.SettlingSpeed...);
    TraceOptions::VisitSeeds(visit, In(of, &DatabaseOptions::Trace)...);
    EnsembleOptions::VisitAir(visit, In(of, &DatabaseOptions::Ensemble)...);
  }

  /// What a user sets.
  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "NumberOfSimulations",
                       { 1, 1e6 },
                       "",
                       "Simulations, each with vortices, winds and obstacles of its own; at most, "
                       "when StopBelow is set." },
          of.NumberOfSimulations...);
    visit(OptionField{ "StopBelow",
                       { 0, 1 },
                       "",
                       "Stop once less than this share of what a simulation brings is new, 0 "
                       "to 1; 0: run them all." },
          of.StopBelow...);
    visit(
      OptionField{ "CoverageTolerance",
                   { 1e-6, 1 },
                   "",
                   "A segment is new when its rms distance to all before is above this fraction "
                   "of the rms chord of the segments of its length." },
      of.CoverageTolerance...);
    visit(TextField("KeptIn", "A folder where simulations that are whole are kept, so that a "
                              "stopped run can be gone on with; they are taken from it when they "
                              "are of the same parameters. It may be removed afterwards."),
          of.KeptIn...);
    VisitSimulations(visit, of...);
    ClusterOptions::VisitSize(visit, In(of, &DatabaseOptions::Cluster)...);
    ClusterTreeOptions::VisitSize(visit,
                                  In(In(of, &DatabaseOptions::Cluster), &ClusterOptions::Trees)...);
    ConnectionOptions::VisitFreedom(
      visit, In(In(of, &DatabaseOptions::Cluster), &ClusterOptions::Connections)...);
    ConnectionOptions::VisitThreshold(
      visit, In(In(of, &DatabaseOptions::Cluster), &ClusterOptions::Connections)...);
  }

private:
  template <class Whole, class Part, class Holder>
  static auto& In(Holder& of, Part Whole::*part)
  {
    if constexpr (std::is_same_v<std::remove_const_t<Holder>, Whole>)
    {
      return of.*part;
    }
    else
    {
      return of;
    }
  }
};

/// One thread a simulation, two frames in memory each. The same options give the same database bit
/// by bit, whatever the number of threads. Provenance lists the parameters. When it is stopped, the
/// database is that of the first simulations that are whole, untouched when there is none (cutting
/// and clustering them takes some seconds more); called again with the same KeptIn it goes on with
/// those that follow. coverage: what each simulation but the first brought.
Result BuildDatabase(const DatabaseOptions& options, const ParallelFor& parallelFor,
                     Monitor& monitor, MotionDatabase& database,
                     std::vector<CoveragePoint>& coverage);
/// The same by the threads of several ranks, to the same bits; called by rank 0, while the others
/// Serve with ServeSimulations among their kinds, as SimulationKind. What VisitSimulations does not
/// name has the defaults there.
Result BuildDatabase(const DatabaseOptions& options, Communicator& ranks,
                     const ParallelFor& parallelFor, Monitor& monitor, MotionDatabase& database,
                     std::vector<CoveragePoint>& coverage);

inline constexpr const char* SimulationKind = "simulations";
/// atOnce: simulations that this rank runs side by side.
Result ServeSimulations(ReadingStream& inputs, SharedItems& items, int atOnce,
                        const ParallelFor& parallelFor);

/// The seed of one of its simulations.
std::uint64_t SimulationSeed(std::uint64_t seed, int simulation);

} // namespace waft
