// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Spacetime/Solver/Lbfgs.h"

#include <memory>
#include <utility>

namespace waft
{

/// A level's frames, shared out among ranks, with as many beside the own ones as E's rows reach.
inline FramePartition PartitionOf(const TimeLevel& level, Communicator& ranks)
{
  return FramePartition(level.NumberOfFrames(), static_cast<std::size_t>(level.Reach()), ranks);
}

/// A level of time with everything that solves on it. Its vectors are of its Partition.
struct LevelSolver
{
  /// history: pairs of L-BFGS; 0: no solver of its own, lists are not kept and a rank holds all
  /// frames. movable: as of HardConstraints.
  LevelSolver(const SpacetimeModel& model, const AirFields& fields, const ConstraintTable& table,
              TimeLevel times, const ParallelFor& parallel, Communicator& ranks, int history,
              const std::vector<char>& movable = {}) :
    Level(std::move(times)),
    Partition(history > 0 ? PartitionOf(this->Level, ranks)
                          : PartitionOf(this->Level, ranks).HoldingAll()),
    Objective(model, fields, this->Level, parallel, FastestSphKernels(), history > 0,
              &this->Partition),
    Preconditioner(model, this->Level, parallel, TimelinePreconditioner::UsualDamping,
                   &this->Partition),
    Constraints(model, this->Level, table, parallel, movable, &this->Partition)
  {
    if (history > 0)
    {
      this->Solver = std::make_unique<Lbfgs>(this->Partition, model.FrameSize(), parallel, history);
    }
  }

  TimeLevel Level;
  FramePartition Partition;
  SpacetimeObjective Objective;
  TimelinePreconditioner Preconditioner;
  HardConstraints Constraints;
  std::unique_ptr<Lbfgs> Solver;
};

} // namespace waft
