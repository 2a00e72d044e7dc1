// SPDX-License-Identifier: BSD-3-Clause
// The last word on clearance: what warping and uniting pushed into something is eased out again.
#pragma once

#include "Constraints/Clearance.h"
#include "Constraints/Warp.h"

#include <vector>

namespace waft
{

struct Violation
{
  int Frame = 0;            // the interval Frame..Frame + 1
  Vec3 Push = Vec3::Zero(); // what would free it [m]
  double Slack = 0.0;       // negative [m]
};

/// Intervals of a path (8 points a frame) that come nearer than required less the tolerance.
std::vector<Violation> FindViolations(const ClearanceField& field,
                                      const std::vector<Vec3>& positions, double tolerance);

/// Eases the path out of what it violates by soft marks in its own warp problem, so that the
/// correction is as smooth as the redistribution; of the path, the corrected one and `fallback`
/// returns the one with the least violation, steps longer than maximumStep [m] counted as such.
std::vector<Vec3> RepairPath(const ClearanceField& field, WarpProblem warp, double tolerance,
                             double maximumStep, const std::vector<Vec3>& path,
                             const std::vector<Vec3>& fallback, double& worstSlack,
                             int& worstFrame);

} // namespace waft
