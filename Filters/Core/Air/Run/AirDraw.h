// SPDX-License-Identifier: BSD-3-Clause
// The sampled air: its forces are drawn.
#pragma once

#include "Air/Run/AirState.h"

namespace waft
{

/// The air in whose coarse run the objects come to their marks with the least control, and move as
/// bodies do in the airs of the databases.
Result DrawAir(const AirContext& run, AirState& state, AssimilationOutput& output);

} // namespace waft
