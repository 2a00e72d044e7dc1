// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Spacetime/Run/SpacetimeDigest.h"

#include <string>
#include <vector>

namespace waft
{

/// What a run leaves for the next one, which goes on from it when the same unknowns are asked for.
struct SpacetimeWarmStart
{
  ProblemDigest Digest;
  StateVector State;            // all frames, gas and objects, as exported [dx]
  std::vector<Vortex> Vortices; // as E ended with them, in dx and frames
  SplineWind Wind;
  std::vector<Vec3> Planned;                // [frame * objects + object, dx]
  std::vector<std::vector<Vec3>> Positions; // exported, by object and frame [m]
  std::string Stage; // of the program, where the run was stopped; empty: it had ended

  bool IsEmpty() const { return this->State.empty(); }
};

} // namespace waft
