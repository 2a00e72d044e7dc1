// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Spacetime/Run/SolverState.h"
#include "Spacetime/Run/SpacetimeDigest.h"

#include <vector>

namespace waft
{

/// What a run leaves for the next one, which goes on from it when the same unknowns are asked for.
struct SpacetimeWarmStart
{
  ProblemDigest Digest;
  SolverState State;                        // as exported; Now: the stage that it was stopped in
  std::vector<Vec3> Planned;                // [frame * objects + object, dx]
  std::vector<std::vector<Vec3>> Positions; // exported, by object and frame [m]

  bool IsEmpty() const { return this->State.Motion.empty(); }
};

} // namespace waft
