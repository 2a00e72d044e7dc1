// SPDX-License-Identifier: BSD-3-Clause
// All that changes in the course of a run, as one value.
#pragma once

#include "Spacetime/Energy/Convergence.h"
#include "Spacetime/Model/AirFields.h"
#include "Spacetime/Model/Schedule.h"
#include "Spacetime/Solver/Lbfgs.h"

#include <cstddef>
#include <vector>

namespace waft
{

/// A run goes from one of these to the next, stage by stage.
struct SolverState
{
  Schedule Plan;
  std::size_t Next = 0;     // stage
  int Coarseness = 0;       // of the level of Part
  double StartEnergy = 0.0; // E of what the run begins with
  std::vector<ConvergenceRow> Log;
  AirFields Fields;
  /// All frames [dx]; empty while a level that holds or replaces all of them is solved.
  StateVector Motion;
  /// What the run began with.
  StateVector Beginning;
  /// Of the level that is solved; empty between levels.
  StateVector Part;
  LbfgsMemory Curvature; // of Part

  bool IsDone() const { return this->Next >= this->Plan.Stages.size(); }
  const Stage& Now() const { return this->Plan.Stages[this->Next]; }
};

} // namespace waft
