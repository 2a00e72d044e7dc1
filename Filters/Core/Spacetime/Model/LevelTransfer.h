// SPDX-License-Identifier: BSD-3-Clause
// Coarse time levels and the passage between them.
#pragma once

#include "Spacetime/Model/ConstraintTable.h"
#include "Spacetime/Model/StateVector.h"
#include "Spacetime/Model/TimeLevel.h"

#include <vector>

namespace waft
{

/// Frames at most `stride` apart that hold the first, the last and every frame where a requirement
/// begins, ends or stands alone. Inside runs of constrained frames (a given path, a rest) only some
/// are kept.
std::vector<int> CoarseFrames(const SpacetimeModel& model, const ConstraintTable& table,
                              int stride);

/// The level's frames of a state at full resolution; velocities are those of the level's steps.
StateVector Restrict(const SpacetimeModel& model, const TimeLevel& level, const StateVector& full);

/// Cubic interpolation of a level's positions to all frames. Velocities are backward differences: a
/// step's velocity belongs to its middle, so those of longer steps would come too early. What the
/// level's velocities differ from its own backward differences is kept.
void Prolong(const SpacetimeModel& model, const TimeLevel& level, const StateVector& coarse,
             StateVector& full);

} // namespace waft
