// SPDX-License-Identifier: BSD-3-Clause
// The order of the seed paper's own optimisation: near to the plan first, from coarse levels of
// time to fine ones, in passes between which the force fields are estimated anew.
#pragma once

#include "Spacetime/Model/Schedule.h"
#include "Spacetime/Scene/SpacetimeSetup.h"

namespace waft
{

/// width: L of the leash, the longest side of the volume [m].
Schedule PlanPasses(const SpacetimeSetup& setup, const SpacetimeOptions& options, double width);

} // namespace waft
