// SPDX-License-Identifier: BSD-3-Clause
// E by several ranks: rank 0 solves, the others evaluate their frames for it. All that MPI asks of
// the solver is here.
#pragma once

#include "Base/Communicator.h"
#include "Base/Result.h"
#include "Spacetime/Solver/LevelSolver.h"

namespace waft
{

/// On rank 0: E of which each rank evaluates a range of the level's frames. States go out,
/// gradients and sums come back, and the bits are those of one rank. Where there is one rank:
/// Objectives. Model and communicator must outlive what is made.
ObjectiveMaker RankedObjectives(const SpacetimeModel& model, const ParallelFor& parallel,
                                Communicator& ranks);

/// On the other ranks: does what rank 0's objectives ask for, until EndEvaluations; returns what
/// that was given.
Result ServeEvaluations(const SpacetimeModel& model, const ParallelFor& parallel,
                        Communicator& ranks);
/// On rank 0, when no objective is left. Does nothing where there is no other rank.
void EndEvaluations(const Result& result, Communicator& ranks);

} // namespace waft
