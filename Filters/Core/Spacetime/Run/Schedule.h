// SPDX-License-Identifier: BSD-3-Clause
// What a run plans to do.
#pragma once

#include "Spacetime/Model/Schedule.h"
#include "Spacetime/Scene/SpacetimeSetup.h"

namespace waft
{

/// From planned tracks: the passes of the paper, where no sampled air is given.
Schedule PlanSchedule(const SpacetimeSetup& setup, const SpacetimeOptions& options, double width);
/// In a sampled air, in which the tracks and their gas fly already: all frames at once, no fields
/// to be found.
Schedule PlanInAir(const SpacetimeOptions& options);

} // namespace waft
