// SPDX-License-Identifier: BSD-3-Clause
// Air that already moves as the planned paths ask for: where the optimisation starts.
#pragma once

#include "Base/Monitor.h"
#include "Spacetime/Energy/SpacetimeObjective.h"

namespace waft
{

/// Fits a smooth, divergence-free flow to the velocities of the objects (less their settling), then
/// lets the gas of `state` (all frames, gas at rest) run forward in time under its own dynamics and
/// the external fields, drawn towards that flow. Objects stay where they are. objective: at full
/// resolution. False when the monitor stopped it or the gas ran away; the gas is then at rest.
bool MakeInitialGas(SpacetimeObjective& objective, const ParallelFor& parallel, Monitor& monitor,
                    StateVector& state);

} // namespace waft
