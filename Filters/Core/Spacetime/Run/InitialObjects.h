// SPDX-License-Identifier: BSD-3-Clause
// Objects that give way to each other in the sampled air: where its optimisation starts.
#pragma once

#include "Base/Monitor.h"
#include "Base/Parallel.h"
#include "Spacetime/Model/ConstraintTable.h"
#include "Spacetime/Model/StateVector.h"
#include "Spacetime/Model/TimeLevel.h"

namespace waft
{

/// Minimises E by the objects of `state` (all frames) alone, as it is while the gas goes with the
/// air: without the sums over gas it costs next to nothing, and what objects ask of each other, of
/// their marks and of surfaces needs many iterations. level: all frames. False when the monitor
/// stopped it; the objects are then as they were.
bool MakeInitialObjects(const SpacetimeModel& model, const ConstraintTable& table,
                        const TimeLevel& level, const ParallelFor& parallel, Monitor& monitor,
                        StateVector& state);

} // namespace waft
