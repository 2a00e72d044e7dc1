// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Spacetime/Solver/Lbfgs.h"

#include <memory>
#include <utility>

namespace waft
{

/// A level of time with everything that solves on it.
struct LevelSolver
{
  /// history: pairs of L-BFGS; 0: no solver of its own, and lists are not kept.
  LevelSolver(const SpacetimeModel& model, const AirFields& fields, const ConstraintTable& table,
              TimeLevel times, const ParallelFor& parallel, int history) :
    Level(std::move(times)),
    Objective(model, fields, this->Level, parallel, FastestSphKernels(), history > 0),
    Preconditioner(model, this->Level, parallel), Constraints(model, this->Level, table, parallel)
  {
    if (history > 0)
    {
      this->Solver =
        std::make_unique<Lbfgs>(this->Level.NumberOfFrames(), model.FrameSize(), parallel, history);
    }
  }

  /// Minimises from `state`, as Lbfgs does.
  LbfgsEnd Minimise(const LbfgsOptions& options, const Lbfgs::Observer& observer, Monitor* monitor,
                    LbfgsMemory& memory, StateVector& state)
  {
    return this->Solver->Minimise(this->Objective, this->Preconditioner, this->Constraints, options,
                                  observer, monitor, memory, state);
  }

  TimeLevel Level;
  SpacetimeObjective Objective;
  TimelinePreconditioner Preconditioner;
  HardConstraints Constraints;
  std::unique_ptr<Lbfgs> Solver;
};

} // namespace waft
