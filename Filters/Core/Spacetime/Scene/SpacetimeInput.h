// SPDX-License-Identifier: BSD-3-Clause
// What a run is about, in world units.
#pragma once

#include "Base/FieldSeries.h"
#include "Constraints/MotionProblem.h"

namespace waft
{

/// Its Vortices are first guesses and priors (see SelectVortices), its Wind a fixed background.
struct SpacetimeInput : MotionProblem
{
  /// Velocity of a sampled air, in which Wind is contained already, or empty: what is solved
  /// for is how gas and objects deviate from it (Model/GivenAir.h).
  FieldSeries Air;
};

} // namespace waft
