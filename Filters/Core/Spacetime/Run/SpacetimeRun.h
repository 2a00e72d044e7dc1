// SPDX-License-Identifier: BSD-3-Clause
// One run of the optimisation: where it starts, its steps, what it leaves.
#pragma once

#include "Spacetime/Run/SpacetimeBudget.h"
#include "Spacetime/Run/SpacetimeEdit.h"
#include "Spacetime/Run/SpacetimeProgram.h"
#include "Spacetime/Run/SpacetimeWarmStart.h"
#include "Spacetime/Scene/SpacetimeOutput.h"
#include "Spacetime/Solver/LevelSolver.h"

#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace waft
{

class SpacetimeRun
{
public:
  SpacetimeRun(const SpacetimeInput& input, const SpacetimeOptions& options,
               const ParallelFor& parallel, Monitor& monitor, SpacetimeOutput& output,
               SpacetimeWarmStart* memory, Communicator& ranks);

  Result Run();

private:
  double Elapsed() const; // since this run began [s]
  double Seconds() const { return this->Before + this->Elapsed(); }
  bool TimeIsUp() const; // for all ranks
  void Record(int pass, const std::string& stage, int iteration, const SpacetimeTerms& terms,
              double violation, double leash);

  /// Where to start. GoOn and Resume: false when there is nothing that fits.
  Result Begin();
  bool GoOn();
  bool Resume();
  void ResetOutside(const StateVector& before);
  /// The cost of State at full resolution, its neighbour lists made anew.
  SpacetimeTerms Measure();

  /// The steps from Next on. EnterLevel moves the motion to a step's level of time, and of several
  /// ranks each then has its share of the frames; LeaveLevel brings it back.
  void TakeSteps();
  void EnterLevel(int coarseness);
  void LeaveLevel();
  StateVector& LevelState()
  {
    return this->Coarseness > 0 || !this->Region.IsEmpty() || this->IsPartitioned()
             ? this->PartState
             : this->State;
  }
  /// The level's motion is in pieces; in windows every rank has all of it.
  bool IsPartitioned() const
  {
    return this->Solver && this->Solver->Solver && !this->Solver->Partition.IsAlone();
  }
  /// Both return false when the run was stopped.
  bool Minimize(const SpacetimeStep& step);
  bool MinimizeInWindows(const SpacetimeStep& step);
  bool SolveWindow(const SpacetimeStep& step, std::pair<std::size_t, std::size_t> window,
                   double done, Monitor& monitor);
  bool HasWindows(const TimeLevel& level) const { return this->Window < level.NumberOfFrames(); }
  /// First and last free level frame of each window of a sweep.
  std::vector<std::pair<std::size_t, std::size_t>> Windows(int sweep) const;
  bool UpdateFields(const SpacetimeStep& step);

  /// A step's observer calls this after each iterate.
  void KeepCheckpoint(bool now);
  /// At each place that a stopped run may go on from; writes the last one, when the run is stopped.
  void MarkState();
  void KeepState();
  bool KeepsCheckpoints() const;
  void WriteCheckpoint();
  void ExchangeCheckpoint(StateArchive& stream);

  Result Finish();
  void KeepTheBetter(const HardConstraints& constraints);
  Result MeasureResult(const TimeLevel& level, const HardConstraints& constraints);
  void WriteOutput(const TimeLevel& level, std::vector<std::vector<Vec3>> positions);
  void Remember(std::vector<std::vector<Vec3>> positions);

  const SpacetimeInput& Input;
  const SpacetimeOptions& Options;
  ParallelFor Parallel;
  Communicator& Ranks;
  Monitor& Own;         // of this rank
  RankMonitor Progress; // of all
  SpacetimeOutput& Output;
  SpacetimeWarmStart* Memory;
  std::chrono::steady_clock::time_point Clock;
  double Before = 0.0; // seconds of the runs that this one goes on from

  SpacetimeSetup Setup;
  SpacetimeProgram Program;
  std::size_t Next = 0;  // step
  bool IsInside = false; // Next's minimisation has begun
  StateVector State;     // all frames
  /// Those of a coarse level or about an edit, and this rank's share of a level.
  StateVector PartState;
  /// What the run began with, unless it goes on from another motion.
  StateVector Beginning;
  EditRegion Region;                   // all that moves, when an edit is local
  std::unique_ptr<LevelSolver> Solver; // of the level that the run is on
  int Coarseness = 0;                  // of that level
  std::size_t Window = 0;              // free frames that are solved at once on the present level
  struct CurrentWindow                 // in a minimisation by windows
  {
    int Sweep = 0;
    std::uint64_t Index = 0;      // of the window, in the sweep
    SpacetimeTerms Terms;         // E of the whole, now
    std::vector<double> Energies; // E of the whole after each sweep
  };
  CurrentWindow Current;

  double AllWork = 1.0;     // expected, in iterations at full resolution
  bool Stopped = false;     // by the monitor
  bool IsCut = false;       // by the time limit: what follows is no course to go on from
  bool GoesOn = false;      // from an earlier motion
  double StartEnergy = 0.0; // E of what the run starts with
  double LastCheckpoint = 0.0, CheckpointCost = 0.0; // s
  bool HasCheckpointFailed = false;
};

} // namespace waft
