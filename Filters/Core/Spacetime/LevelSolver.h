// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Spacetime/Lbfgs.h"
#include "Spacetime/SpacetimeSetup.h"

#include <memory>
#include <utility>

namespace waft
{

/// A level's frames, shared out among ranks, with as many beside the own ones as E's rows reach.
inline FrameShare ShareOf(const TimeLevel& level, Communicator& ranks)
{
  return FrameShare(level.NumberOfFrames(), static_cast<std::size_t>(level.Reach()), ranks);
}

/// A level of time with everything that solves on it. Its vectors are of its Share.
struct LevelSolver
{
  /// history: pairs of L-BFGS; 0: no solver of its own, lists are not kept and a rank holds all
  /// frames. movable: as of HardConstraints.
  LevelSolver(const SpacetimeSetup& setup, TimeLevel times, const ParallelFor& parallel,
              Communicator& ranks, int history, const std::vector<char>& movable = {}) :
    Level(std::move(times)),
    Share(history > 0 ? ShareOf(this->Level, ranks) : ShareOf(this->Level, ranks).HoldingAll()),
    Objective(setup.Model, this->Level, parallel, FastestSphKernels(), history > 0, &this->Share),
    Preconditioner(setup.Model, this->Level, parallel, TimelinePreconditioner::UsualDamping,
                   &this->Share),
    Constraints(setup.Model, this->Level, setup.Table, parallel, movable, &this->Share)
  {
    if (history > 0)
    {
      this->Solver =
        std::make_unique<Lbfgs>(this->Share, setup.Model.FrameSize(), parallel, history);
    }
  }

  TimeLevel Level;
  FrameShare Share;
  SpacetimeObjective Objective;
  TimelinePreconditioner Preconditioner;
  HardConstraints Constraints;
  std::unique_ptr<Lbfgs> Solver;
};

} // namespace waft
