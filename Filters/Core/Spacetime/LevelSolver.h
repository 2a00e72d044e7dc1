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
  /// history: pairs of L-BFGS; 0: no solver of its own, and lists are not kept. movable: as of
  /// HardConstraints.
  LevelSolver(const SpacetimeSetup& setup, TimeLevel times, const ParallelFor& parallel,
              int history, const std::vector<char>& movable = {}) :
    Level(std::move(times)),
    Objective(setup.Model, this->Level, parallel, FastestSphKernels(), history > 0),
    Preconditioner(setup.Model, this->Level, parallel),
    Constraints(setup.Model, this->Level, setup.Table, parallel, movable)
  {
    if (history > 0)
    {
      this->Solver = std::make_unique<Lbfgs>(this->Level.NumberOfFrames(), setup.Model.FrameSize(),
                                             parallel, history);
    }
  }

  TimeLevel Level;
  SpacetimeObjective Objective;
  TimelinePreconditioner Preconditioner;
  HardConstraints Constraints;
  std::unique_ptr<Lbfgs> Solver;
};

} // namespace waft
