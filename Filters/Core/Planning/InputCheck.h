// SPDX-License-Identifier: BSD-3-Clause
// What a plan cannot begin with, and what is odd about one.
#pragma once

#include "Planning/Planner.h"

namespace waft
{

/// Fails on what is malformed: no frames, no volume, ids that occur twice, rows and guides of
/// unknown objects or frames, numbers that are not finite. The message names object and frame.
Result CheckPlanInput(const PlanInput& input);

/// Factor of a database's lengths, and with them speeds, that brings the longest side of its volume
/// as near to the scene's as to twice or half of it; 1 where it is that near as it is.
double DatabaseScale(const MotionDatabase& database, const SceneInfo& scene);

/// What is odd about flying a scene on a database, a sentence each: a frame rate more than twice,
/// or less than half, of the database's (segments are resampled).
std::vector<std::string> DatabaseRemarks(const MotionDatabase& database, const SceneInfo& scene);

/// Builds the obstacles that paths are planned around; each is checked for cutting itself, too.
Result BuildPlanObstacles(std::vector<ObstacleMesh> meshes, ObstacleSet& obstacles);

/// DatabaseRemarks, and what no line of the report could say: of objects without a row.
std::vector<std::string> PlanRemarks(const MotionDatabase& database, const SceneInfo& scene,
                                     const PlanOutput& plan);

} // namespace waft
