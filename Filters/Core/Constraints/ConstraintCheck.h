// SPDX-License-Identifier: BSD-3-Clause
// Which constraints can be met, and how far a motion is from them: the lines of the Report.
#pragma once

#include "Base/Motion.h"
#include "Base/Pose.h"
#include "Base/Types.h"
#include "Constraints/Constraint.h"
#include "Obstacles/ObstacleSet.h"

#include <string>
#include <utility>
#include <vector>

namespace waft
{

/// Judges constraints before anything is planned. One line per (Row, Target), in that order; rows
/// of equal Row and Target are judged together, Kind and Frame of the line are those of the first.
/// Status Infeasible: impossible by itself (a position inside an obstacle or outside the volume,
/// its ball wholly so; a rest with nothing, or something that moves, below; an object that does not
/// exist; more targets of one group than objects of the class; a frame or a number out of range).
/// Positions inside the surface that their object lands on or lies on at that time are allowed.
/// Status Conflict: contradicts lines before it, about the same object, or the object's start:
/// the message names them and the earlier lines are kept. Exact ones contradict each other where
/// they, as linear equations on positions (velocity and acceleration as central differences), have
/// no common solution; balls where they have no common point, or none with the velocities and
/// accelerations on adjacent frames. Rows with ObjectId -1 are judged for conflicts once assigned:
/// call again then. A row that an earlier stage found unmet (its Status) stays so. All else is Met,
/// with an empty message and no residual yet.
std::vector<ReportRow> JudgeConstraints(const std::vector<Constraint>& constraints,
                                        const std::vector<MotionObject>& objects,
                                        const ObstacleSet& obstacles, const SceneInfo& scene);

/// "row 3 target 0 (position at frame 60)"
std::string LineName(int row, int target, ConstraintKind kind, int frame);

/// The line of a row and target; null where there is none. report: as JudgeConstraints orders it.
const ReportRow* FindLine(const std::vector<ReportRow>& report, int row, int target);
inline ReportRow* FindLine(std::vector<ReportRow>& report, int row, int target)
{
  return const_cast<ReportRow*>(FindLine(std::as_const(report), row, target));
}

/// Is this constraint's line of the report met (so far)? Those that are not bind nobody.
bool IsBinding(const Constraint& constraint, const std::vector<ReportRow>& report);

/// Fills Residual (distance beyond Radius, in the unit of Value) and ObjectId of the lines of
/// positions, velocities, accelerations and rests, from positions: velocities and accelerations by
/// CentralDifferences once and twice, a rest by its largest distance to the resting position from
/// Frame to Until. A line that was Met and exceeds the tolerance (1e-9 L; 1e-6 of the tracks' top
/// speed; for accelerations that, times frames per second) becomes Unreachable; the message says by
/// how much, after any sentence that was there. Lines that were not Met keep Status and Message;
/// that of an Unreachable position goes on with how near it comes. A position that no object was
/// given to is measured by the object that comes nearest.
void MeasureResiduals(const std::vector<Constraint>& constraints, const std::vector<Track>& tracks,
                      const std::vector<MotionObject>& objects, const ObstacleSet& obstacles,
                      const SceneInfo& scene, std::vector<ReportRow>& report);

/// The same for orientations [rad beyond Radius], tolerance 1e-6 rad.
void MeasureOrientationResiduals(const std::vector<Constraint>& constraints,
                                 const std::vector<PoseTrack>& poses,
                                 std::vector<ReportRow>& report);

} // namespace waft
