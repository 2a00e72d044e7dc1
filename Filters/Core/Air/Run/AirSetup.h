// SPDX-License-Identifier: BSD-3-Clause
// What a run begins with.
#pragma once

#include "Air/Run/AirState.h"

namespace waft
{

/// A body with rows that bind it, and what it is given at its start.
BodyProblem ProblemOf(const AirContext& run, const MotionObject& object,
                      const std::vector<Vec3>& plan, std::vector<Constraint> rows);

/// The objects on their planned paths, with the rows that bind them; the output gets all rows and
/// what is judged of them before.
Result SetUpBodies(const AirContext& run, AirBodies& bodies, AssimilationOutput& output);

/// What makes the air, but for the forces.
/// Those of the run, and which of them the air meets.
Result SetUpObstacles(AirContext& run);
AirScene SetUpScene(const AirContext& run, const AssimilationOptions& options);

} // namespace waft
