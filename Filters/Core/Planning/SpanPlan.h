// SPDX-License-Identifier: BSD-3-Clause
// One free span: search, redistribution, refinement, blending, retiming, and the check of what
// came out.
#pragma once

#include "Planning/FreeSpaceGrid.h"
#include "Planning/SpanFit.h"

#include <atomic>
#include <functional>

namespace waft
{

struct SpanPlanOptions
{
  double RetimingLimit = 0.15;
  double JoinThreshold = 0.05; // score at which a join is taken at once
  double Margin = 0.02;        // m, kept beyond the clearance radius while growing
  double CheckMargin = 0.001;  // m, kept beyond it by what comes out
  int MaximumNumberOfBranches = 20000;
  int NumberOfCandidates = 32;   // paths found, of which the one nearest to the style is taken
  double GuideWeight = 0.5;      // 0..1
  double FrameStep = 1.0 / 30.0; // s
  const std::atomic<bool>* Stop = nullptr; // asked for while searching
  const StyleGauge* Gauge = nullptr;       // or null: the first path found is taken
  /// Maps from coarse (0) to fine, null when there is none finer: asked where the straight way is
  /// blocked, or empty.
  std::function<const FreeSpaceGrid*(int)> Rooms;
};

/// Always returns a path, as near as possible when the goal was not reached.
SpanResult PlanSpan(const SegmentLibrary& library, const ClearanceField& field,
                    const SpanRequest& request, const SpanPlanOptions& options, Random random);

} // namespace waft
