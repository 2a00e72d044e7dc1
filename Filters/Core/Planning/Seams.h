// SPDX-License-Identifier: BSD-3-Clause
// All flights of an object made one motion: its rows met, acceleration continuous where they meet.
#pragma once

#include "Constraints/Warp.h"
#include "Planning/Itinerary.h"

#include <vector>

namespace waft
{

/// What the second differences of a warp jump by at the seams (samples, ascending) is handed over
/// within `reach` samples to either side, at most half way to the next seam; by itself that leaves
/// the velocity beyond as it was. What is fixed sample by sample stays, and the flight next to it
/// takes all of the jump.
void HealSeams(const std::vector<int>& seams, int reach, WarpProblem& warp);

/// One position a sample, with every row met. The second differences of the warp become those that
/// are continuous at seams and rows, its rows those that are imposed: the ones without tolerance
/// and those that the motion does not meet by itself.
std::vector<Vec3> UniteFlights(const std::vector<int>& seams, int reach,
                               const std::vector<MotionRow>& rows, WarpProblem& warp);

} // namespace waft
