// SPDX-License-Identifier: BSD-3-Clause
// Coarse time levels and the passage between them.
#pragma once

#include "Spacetime/HardConstraints.h"
#include "Spacetime/SpacetimeModel.h"
#include "Spacetime/StateVector.h"

#include <vector>

namespace waft
{

/// Frames at most `stride` apart that hold the first, the last and every frame where a requirement
/// begins, ends or stands alone. Inside runs of constrained frames (a given path, a rest) only some
/// are kept.
std::vector<int> CoarseFrames(const SpacetimeModel& model, const ConstraintTable& table,
                              int stride);

/// The level's frames of a state at full resolution.
StateVector Restrict(const SpacetimeModel& model, const TimeLevel& level, const StateVector& full);

/// Linear interpolation of a level's state to all frames.
void Prolong(const SpacetimeModel& model, const TimeLevel& level, const StateVector& coarse,
             StateVector& full);

} // namespace waft
