// SPDX-License-Identifier: BSD-3-Clause
// What the fields explain of a motion: vortices beside a wind, and both of bodies that they were
// not solved for.
#pragma once

#include "Base/Parallel.h"
#include "Spacetime/Energy/SpacetimeObjective.h"
#include "Spacetime/Paper/FieldNormal.h"
#include "Spacetime/Scene/SpacetimeOutput.h"

namespace waft
{

/// By how much Ev of the objects rises when the vortices are taken away and, with `solvesWind`, the
/// wind is solved for anew, over what Ev of the objects is without either. The user's wind acts in
/// each. The objective must just have been evaluated at `state`. Not a number in a sampled air, and
/// where nothing flies freely.
double PartOfVortices(const SpacetimeObjective& objective, const StateVector& state,
                      bool solvesWind, const ParallelFor& parallel);

/// The chosen fields are solved for without one object and one gas particle in five: what part they
/// then explain of the accelerations that are asked of them. Likewise.
FieldsPart PartOfFields(const SpacetimeObjective& objective, const StateVector& state,
                        const FieldChoice& choice, const ParallelFor& parallel);

} // namespace waft
