// SPDX-License-Identifier: BSD-3-Clause
// The other half of the alternation: force fields for the motion as it is (Shi et al. 2005,
// section 5).
#pragma once

#include "Base/Monitor.h"
#include "Spacetime/Energy/SpacetimeObjective.h"
#include "Spacetime/Model/SpacetimeUnits.h"
#include "Spacetime/Paper/FieldNormal.h"

#include <string>
#include <vector>

namespace waft
{

/// Solves strengths and wind anew for all particles, and keeps them where E falls by more than a
/// millionth of itself. fields: those of the objective. terms: E at `state` before, and after.
/// dropped: ids of vortices that explain next to nothing and were left out. False when the monitor
/// stopped it.
bool SolveFields(AirFields& fields, SpacetimeObjective& objective, const StateVector& state,
                 const FieldChoice& choice, const ParallelFor& parallel, Monitor* monitor,
                 SpacetimeTerms& terms, std::vector<int>& dropped);

/// Fits poles, times, durations and cores of the vortices to the accelerations that all particles
/// ask of them, from the recorded ones, solves strengths and wind with the new shapes, and keeps
/// both where E is lower by more than a millionth of itself than with strengths and wind alone
/// solved anew. As SolveFields.
bool RefitVortices(AirFields& fields, const SpacetimeUnits& units, SpacetimeObjective& objective,
                   const std::vector<Track>& planned, const Box& bounds, std::uint64_t seed,
                   const StateVector& state, const FieldChoice& choice, const ParallelFor& parallel,
                   Monitor& monitor, SpacetimeTerms& terms, std::vector<int>& dropped);

} // namespace waft
