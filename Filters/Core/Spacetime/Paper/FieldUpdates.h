// SPDX-License-Identifier: BSD-3-Clause
// The other half of the alternation: force fields for the motion as it is.
#pragma once

#include "Base/Monitor.h"
#include "Spacetime/Energy/SpacetimeObjective.h"
#include "Spacetime/Model/SpacetimeUnits.h"

#include <vector>

namespace waft
{

/// Positions of all objects at all frames of a level [level frame * objects + object].
std::vector<Vec3> ObjectPositions(const SpacetimeModel& model, std::size_t frames,
                                  const StateVector& state);

/// Weakens the estimated wind so that its root mean square at the objects, over their flights and
/// over all frames, keeps a bound set by the vortices there (1.8 times theirs). None where there
/// are none. positions: ObjectPositions.
void HoldWind(const SpacetimeModel& model, const TimeLevel& level,
              const std::vector<Vec3>& positions, AirFields& fields);

/// Holds the wind to a bound set by the vortices, estimates it anew, and keeps that where E falls.
/// fields: those of the objective. terms: E at `state` before, and after. False when the monitor
/// stopped it.
bool UpdateWind(AirFields& fields, SpacetimeObjective& objective, const StateVector& state,
                const ParallelFor& parallel, Monitor* monitor, SpacetimeTerms& terms);

/// Fits the vortices to the accelerations that the objects' motion asks for (Shi et al. 2005,
/// section 5) and keeps them where E does not grow by more than a few percent.
bool UpdateVortices(AirFields& fields, const SpacetimeUnits& units, SpacetimeObjective& objective,
                    const std::vector<Track>& planned, const Box& bounds, std::uint64_t seed,
                    const StateVector& state, Monitor& monitor, SpacetimeTerms& terms);

} // namespace waft
