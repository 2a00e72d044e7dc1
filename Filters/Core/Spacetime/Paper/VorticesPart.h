// SPDX-License-Identifier: BSD-3-Clause
// What vortices explain of a motion that a wind alone would not.
#pragma once

#include "Base/Parallel.h"
#include "Spacetime/Energy/SpacetimeObjective.h"

namespace waft
{

/// By how much Ev of the objects rises when the vortices are taken away and, with `solvesWind`, the
/// wind is solved for anew, over what Ev of the objects is without either. The user's wind acts in
/// each. The objective must just have been evaluated at `state`. Not a number in a sampled air, and
/// where nothing flies freely.
double PartOfVortices(const SpacetimeObjective& objective, const StateVector& state,
                      bool solvesWind, const ParallelFor& parallel);

} // namespace waft
