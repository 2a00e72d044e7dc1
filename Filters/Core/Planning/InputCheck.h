// SPDX-License-Identifier: BSD-3-Clause
// What a plan cannot begin with, and what is odd about one.
#pragma once

#include "Planning/Planner.h"

namespace waft
{

/// Fails on what is malformed: no frames, no volume, ids that occur twice, rows and guides of
/// unknown objects or frames, numbers that are not finite. The message names object and frame.
Result CheckPlanInput(const PlanInput& input);

/// What is odd about flying a scene on a database, a sentence each: a frame rate (segments are
/// resampled) or a width of the volume (segments keep their size) that is more than twice, or less
/// than half, of the database's.
std::vector<std::string> DatabaseRemarks(const MotionDatabase& database, const SceneInfo& scene);

/// Builds the obstacles that paths are planned around; each is checked for cutting itself, too.
Result BuildPlanObstacles(std::vector<ObstacleMesh> meshes, ObstacleSet& obstacles);

/// DatabaseRemarks, and what no line of the report could say: of objects without a row.
std::vector<std::string> PlanRemarks(const MotionDatabase& database, const SceneInfo& scene,
                                     const PlanOutput& plan);

} // namespace waft
