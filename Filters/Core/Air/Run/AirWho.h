// SPDX-License-Identifier: BSD-3-Clause
// Who goes where, by the air.
#pragma once

#include "Air/Run/AirState.h"

#include <vector>

namespace waft
{

/// Gives targets that were given out by the shortest legs (Constraint::Choice) out anew, group by
/// group in time, so that the objects' least controls in the air as it was drawn have the least sum
/// of squares: of up to 100 objects all pairs are tried, of up to 1000 the 24 nearest of each
/// target; more keep their targets, as do those whose way to another one leads through an obstacle,
/// and rows that do not bind. Rows, plans and bodies of the run are then those. The drifts that
/// were found are the plans of who has another target.
Result ChooseWho(AirContext& run, AirState& state, AssimilationOutput& output);

/// As an earlier run had it, by (Row, Target), at the frames of then where they are in the windows
/// of now; what is new there takes who is left over of its group. plans: by track, those of objects
/// with other targets than the input's.
Result TakeWho(const std::vector<int>& who, const std::vector<std::vector<Vec3>>& plans,
               AirContext& run, AirBodies& bodies, AssimilationOutput& output);
/// Row, Target, ObjectId and frame of arrival (-1: not chosen) of each row whose object or frame
/// was chosen.
std::vector<int> WhoOf(const AirContext& run);
/// Plans that are not the input's; empty lists for the others.
std::vector<std::vector<Vec3>> PlansOf(const AirContext& run);

} // namespace waft
