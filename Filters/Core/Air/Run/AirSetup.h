// SPDX-License-Identifier: BSD-3-Clause
// What a run begins with.
#pragma once

#include "Air/Run/AirState.h"

namespace waft
{

/// The objects on their planned paths, with the rows that bind them; the output gets all rows and
/// what is judged of them before.
Result SetUpBodies(const AirContext& run, AirBodies& bodies, AssimilationOutput& output);

/// What makes the air, but for the forces.
AirScene SetUpScene(const AirContext& run);

} // namespace waft
