// SPDX-License-Identifier: BSD-3-Clause
// What became of each row over the whole run, out of what the stages say of it.
#pragma once

#include "Constraints/Constraint.h"

#include <vector>

namespace waft
{

/// A line, of a rest with the frame of its TouchDown, from which it is Settled, and until which it
/// is kept (-1: of other rows, and where no stage says).
struct JoinedRow : ReportRow
{
  int LiftOff = -1;
};

/// moved: of the stage that moves the objects; planned: of the planner, whose reasons stand before
/// how near the motion comes; turned: of the rotation, which measures the orientation rows that are
/// met so far; rests: the constraints with their touch-downs, may be empty.
std::vector<JoinedRow> JoinReports(const std::vector<ReportRow>& moved,
                                   const std::vector<ReportRow>& planned,
                                   const std::vector<ReportRow>& turned,
                                   const std::vector<Constraint>& rests);

} // namespace waft
