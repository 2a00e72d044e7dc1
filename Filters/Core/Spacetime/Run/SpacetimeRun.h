// SPDX-License-Identifier: BSD-3-Clause
// One run of the optimisation: a state to begin with, a stage after the other, what it leaves.
#pragma once

#include "Spacetime/Model/FrameView.h"
#include "Spacetime/Run/SolverState.h"
#include "Spacetime/Scene/SpacetimeExport.h"
#include "Spacetime/Scene/SpacetimeOutput.h"
#include "Spacetime/Solver/LevelSolver.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace waft
{

class SpacetimeRun
{
public:
  SpacetimeRun(const SpacetimeInput& input, const SpacetimeOptions& options,
               const SpacetimeSetup& problem, const ParallelFor& parallel, Monitor& monitor,
               SpacetimeOutput& output);

  /// start: all frames of the planned motion.
  Result Run(StateVector start);
  /// Motion and fields that Run came to, in the solver's own units.
  const SolverState& Last() const { return this->State; }

private:
  double Elapsed() const; // since this run began [s]
  bool TimeIsUp() const;
  /// Of the run, once the stages before that one are done.
  double FractionAt(std::size_t stage) const;
  void Record(int pass, const std::string& stage, int iteration, const SpacetimeTerms& terms,
              double violation, double leash);

  Result Begin(StateVector start);
  /// The cost of a motion at full resolution, its neighbour lists made anew.
  SpacetimeTerms Measure(const StateVector& motion) const;

  /// One stage; false when the run is to end.
  bool RunStage();
  /// Makes Part and what solves on it, and puts Part back.
  void EnterLevel(int coarseness);
  void MakeLevel(int coarseness);
  void LeaveLevel();
  /// All three return false when the run was stopped.
  bool Minimise(const Stage& stage);
  bool MinimiseInWindows(const Stage& stage);
  /// terms: E of the whole, which goes along.
  bool SolveWindow(const Stage& stage, std::pair<std::size_t, std::size_t> window, double done,
                   Monitor& monitor, SpacetimeTerms& terms);
  bool UpdateFields(const Stage& stage);
  bool HasWindows(const TimeLevel& level) const { return this->Window < level.NumberOfFrames(); }
  /// First and last free level frame of each window of a sweep.
  std::vector<std::pair<std::size_t, std::size_t>> Windows(int sweep) const;

  /// The objects' motion so far, now and then, for a monitor that publishes.
  void PublishMotion();
  Result Export();
  void KeepTheBetter(const HardConstraints& constraints);
  void MeasureRepairs(const std::vector<Vec3>& solved,
                      const std::vector<std::vector<Vec3>>& exported);
  Result MeasureResult(SpacetimeObjective& objective, const HardConstraints& constraints,
                       FieldExport& fields);
  void WriteOutput();
  /// Between two parts of what is measured in the end.
  void TickMeasuring();

  const SpacetimeInput& Input;
  const SpacetimeOptions& Options;
  const SpacetimeSetup& Problem;
  ParallelFor Parallel;
  Monitor& Progress;
  SpacetimeOutput& Output;
  std::chrono::steady_clock::time_point Clock;

  SolverState State;
  std::optional<FrameView> View;       // that Part is of
  std::unique_ptr<LevelSolver> Solver; // of Part
  std::size_t Window = 0;              // free frames that are solved at once on the present level
  double AllWork = 1.0;                // expected, in iterations at full resolution
  std::chrono::steady_clock::time_point Published; // last
  bool Stopped = false;                            // by the monitor
  bool IsCut = false;                              // by the time limit
};

} // namespace waft
