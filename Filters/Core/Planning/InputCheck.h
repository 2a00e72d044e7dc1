// SPDX-License-Identifier: BSD-3-Clause
// What a plan cannot begin with.
#pragma once

#include "Planning/Planner.h"

namespace waft
{

/// Fails on what is malformed: no frames, no volume, ids that occur twice, rows and guides of
/// unknown objects or frames, numbers that are not finite. The message names the place.
Result CheckPlanInput(const PlanInput& input);

} // namespace waft
