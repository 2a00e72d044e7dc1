// SPDX-License-Identifier: BSD-3-Clause
// Objects that lie still from the first frame on.
#pragma once

#include "Base/Motion.h"
#include "Base/Result.h"
#include "Constraints/Constraint.h"
#include "Obstacles/ObstacleSet.h"

#include <string>
#include <vector>

namespace waft
{

/// Puts each object that a rest holds at frame 0 on the surface below its start, where its centre
/// is then at most its clearance radius away: a start that is typed by eye is meant to lie there. A
/// rest that waits for its object holds the one that starts straight above or below it. moved: a
/// sentence that says how many were put by how much, empty where none was.
Result SettleStarts(const std::vector<ObstacleMesh>& obstacles, const std::vector<Constraint>& rows,
                    std::vector<MotionObject>& objects, std::string& moved);

} // namespace waft
