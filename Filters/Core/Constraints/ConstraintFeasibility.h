// SPDX-License-Identifier: BSD-3-Clause
// Constraints that are impossible by themselves.
#pragma once

#include "Base/Motion.h"
#include "Base/Types.h"
#include "Constraints/Constraint.h"
#include "Constraints/Rest.h"
#include "Obstacles/ObstacleSet.h"

#include <string>
#include <vector>

namespace waft
{

/// Why this constraint cannot be, or an empty text. object: whose it is, nullptr while not
/// assigned. windows: the object's landings.
std::string WhyInfeasible(const Constraint& row, const MotionObject* object,
                          const std::vector<LandingWindow>& windows, const ObstacleSet& obstacles,
                          const SceneInfo& scene);

/// Why an object cannot be where it starts, or an empty text. windows: its landings.
std::string WhyStartInfeasible(const MotionObject& object,
                               const std::vector<LandingWindow>& windows,
                               const ObstacleSet& obstacles, const SceneInfo& scene);

/// For each constraint, in order: true when its target cannot get an object of its own because its
/// group has more targets than there are objects of the class. Objects that the group names go
/// first, then earlier targets.
std::vector<bool> FindUnassignable(const std::vector<Constraint>& constraints,
                                   const std::vector<MotionObject>& objects);

} // namespace waft
