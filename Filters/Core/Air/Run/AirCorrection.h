// SPDX-License-Identifier: BSD-3-Clause
// What an air is changed by for the marks' sake: a wind added to it, and the air simulated with the
// force of that.
#pragma once

#include "Air/Run/AirState.h"

namespace waft
{

/// The air with the wind that makes the controls needless, found jointly with the paths. In the air
/// as drawn all turn, and in each then those whose poses are not what it makes of them.
Result AddWind(const AirContext& run, AirState& state, AssimilationOutput& output);

/// The air as it is with what its bodies on their paths lack still.
void AddRest(const AirContext& run, AirState& state, AssimilationOutput& output);

/// Towards the air as it is, by what its motion asks for beside what drives it in `plain`; then the
/// objects drift in it.
Result SimulateAgain(const AirContext& run, const HalfSeries& plain, AirState& state,
                     AssimilationOutput& output);

} // namespace waft
