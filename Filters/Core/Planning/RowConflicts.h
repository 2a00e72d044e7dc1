// SPDX-License-Identifier: BSD-3-Clause
// Rows of one object that lie too far apart for the time between them.
#pragma once

#include "Base/Motion.h"
#include "Constraints/Constraint.h"
#include "Obstacles/ObstacleSet.h"
#include "Planning/Legs.h"

#include <vector>

namespace waft
{

/// Judges the rows as JudgeConstraints does, and before contradictions of other kinds those of
/// speed: what asks an object to go from one line's stop to another's at more than SpeedAllowance
/// times the database's top speed. Of such lines the fewest are given up, of equally many the later
/// ones in the list: Conflict, with the kept lines named. Within a line (a given path) any speed
/// will do. A line that cannot be reached from the start is Unreachable, and given up where others
/// are met later; where none are it stays for the planner to come as near as it can.
std::vector<ReportRow> JudgeWithSpeeds(const std::vector<Constraint>& constraints,
                                       const std::vector<MotionObject>& objects,
                                       const ObstacleSet& obstacles, const SceneInfo& scene,
                                       const SpeedLimit& limit);

} // namespace waft
