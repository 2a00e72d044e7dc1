// SPDX-License-Identifier: BSD-3-Clause
// What a run gives out.
#pragma once

#include "Air/Run/AirState.h"

namespace waft
{

/// Before there is an air the plan is the best so far.
void KeepPlan(const AirContext& run, AssimilationOutput& output);

/// Paths exactly through what is asked for, and what else is given out; the air goes over to the
/// output. Who stops does not wait until objects give way to each other.
Result FinishRun(const AirContext& run, bool isStopped, AirState& state,
                 AssimilationOutput& output);

} // namespace waft
