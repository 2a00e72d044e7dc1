// SPDX-License-Identifier: BSD-3-Clause
// Better continuity from the lower levels of the clusters (Shi et al. 2005, section 4).
#pragma once

#include "Planning/Blending.h"

namespace waft
{

struct RefinementResult
{
  double CostBefore = 0.0; // sum over all connections, dimensionless
  double CostAfter = 0.0;
  int NumberOfReplaced = 0;
};

/// Discontinuity of the steps in the window shared by two pieces: sum of squared differences over
/// sum of squared steps.
double ConnectionCost(const SegmentLibrary& library, const Piece& before, const Piece& after);

/// Replaces each piece but the first and the last by the member of its cluster that continues both
/// neighbours best, found by descending the cluster tree greedily from medoid to medoid; a piece is
/// replaced only when the sum of its two connection costs falls and its displacement stays within
/// `maximumShift` [m] of what it was. The pieces after it move along. Never raises the total cost.
RefinementResult RefineChain(const SegmentLibrary& library, double maximumShift, PieceChain& chain);

} // namespace waft
