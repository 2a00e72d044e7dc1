// SPDX-License-Identifier: BSD-3-Clause
// What the parts of a run brought, in figures.
#pragma once

#include "Air/Drift/ResidualControl.h"
#include "Air/Field/WindCorrection.h"
#include "Air/Run/AirState.h"

#include <string>
#include <vector>

namespace waft
{

/// One a body.
std::vector<ResidualControl> ResidualControlsOf(const AirContext& run, const AirBodies& bodies,
                                                const HalfSeries& air);

/// A row of a part that is done. common: null, or the wind that the air has.
AssimilationRound RoundOf(const AirContext& run, const AirState& state, const std::string& stage,
                          const WindCorrection* correction = nullptr);

/// Warns of objects that the air does not take to their marks. flow: rms of the air's velocity at
/// the bodies [m/s].
void WarnOfLargeControls(const AirContext& run, const AirBodies& bodies, const HalfSeries& air,
                         double flow, std::vector<std::string>& warnings);

} // namespace waft
