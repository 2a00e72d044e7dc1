// SPDX-License-Identifier: BSD-3-Clause
// What the planner says about its plans: lines of rows, of flights and of objects.
#pragma once

#include "Constraints/Constraint.h"
#include "Planning/ObjectPlan.h"
#include "Planning/Planner.h"

namespace waft
{

/// Reports in the lines of the object's rows what became of them, and adds its flights and its own
/// line.
void ReportObject(const MotionObject& object, const ObjectPlan& plan, bool isPlanned,
                  PlanOutput& output);

/// An object that cannot be where it starts is named in its own line, and in each line of its rows;
/// they may be met all the same.
void ReportStarts(const PlanInput& input, PlanOutput& output);

/// Later stages must not force what no path was found for: that would be a jump.
void MarkUnmet(const std::vector<ReportRow>& report, std::vector<Constraint>& constraints);

/// Counts the lines of each object, and takes the worst status over into its own.
void CountLines(PlanOutput& output);

/// The paths of all objects, in their order, while they are planned: those that are not yet stand
/// where they begin.
std::vector<Track> TracksSoFar(const std::vector<Track>& planned,
                               const std::vector<MotionObject>& objects, const Timeline& time);

} // namespace waft
