// SPDX-License-Identifier: BSD-3-Clause
// What a scene that loops asks for: the places of its last frame lead on to those of its first.
#pragma once

#include "Base/Motion.h"
#include "Base/Result.h"
#include "Constraints/Constraint.h"
#include "Obstacles/ObstacleSet.h"

#include <vector>

namespace waft
{

/// Adds rows of a number of their own (Row), at the frame after the last: each object that is there
/// at the end goes on as one of its shape that is there at the beginning, whose ObjectId is the
/// row's Target, with its place, and its velocity where one is given or it hangs. Who takes whose
/// place is chosen by the shortest legs (Choice), but of who lies to the end, which goes on as one
/// that lies there. Rests and holds to the last frame go on to that frame. Errors: of a shape as
/// many are not there at the end as at the beginning; who lies to the end where none lies at the
/// beginning; an obstacle that is not back by then.
Result CloseLoop(const SceneInfo& scene, const std::vector<MotionObject>& objects,
                 const ObstacleSet& obstacles, std::vector<Constraint>& rows, int& number);

} // namespace waft
