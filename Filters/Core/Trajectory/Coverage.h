// SPDX-License-Identifier: BSD-3-Clause
// How much a further simulation adds to a motion database: Shi et al. 2005 stop when no new shapes
// of trajectories are seen (end of section 3.1).
#pragma once

#include "Trajectory/MotionDatabase.h"

#include <vector>

namespace waft
{

struct CoveragePoint
{
  int Simulations = 0;   // in the database when the next one came
  int NewSegments = 0;   // that the next one brought
  double NewShare = 0.0; // of these, farther from all before than the tolerance, 0..1
};

/// One point per simulation but the first. A segment is new when its rms distance over the samples
/// to every earlier segment of its length is above tolerance times the rms chord of the segments of
/// that length.
std::vector<CoveragePoint> CoverageCurve(const MotionDatabase& database, double tolerance = 0.05);

} // namespace waft
