// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Spacetime/Lbfgs.h"
#include "Spacetime/SpacetimeSetup.h"

#include <memory>
#include <utility>

namespace waft
{

/// A level of time with everything that solves on it.
struct LevelSolver
{
  /// movable: as of HardConstraints.
  LevelSolver(const SpacetimeSetup& setup, TimeLevel times, const ParallelFor& parallel,
              int history, const std::vector<char>& movable = {}) :
    Level(std::move(times)),
    Objective(setup.Model, this->Level, parallel, FastestSphKernels()),
    Preconditioner(setup.Model, this->Level, parallel),
    Constraints(setup.Model, this->Level, setup.Table, parallel, movable),
    Solver(this->Level.NumberOfFrames(), setup.Model.FrameSize(), parallel, history)
  {
  }

  TimeLevel Level;
  SpacetimeObjective Objective;
  TimelinePreconditioner Preconditioner;
  HardConstraints Constraints;
  Lbfgs Solver;
};

} // namespace waft
