// SPDX-License-Identifier: BSD-3-Clause
// The path of a span laid through its marks, and brought down gently where it lands.
#pragma once

#include "Constraints/Warp.h"
#include "Planning/Span.h"

#include <vector>

namespace waft
{

/// The span's samples within a warp: those before it, its frames, and those of lying still after.
struct SpanWarp
{
  SpanClock Clock;
  int Before = 0;
  int After = 0;
  int Landing = 0; // frame from which it is brought down, 0: it is not
  WarpProblem Problem;

  /// Positions at the frames 0..Clock.Frames, as the problem has them.
  std::vector<Vec3> Frames() const;
};

/// path: what is flown at the frames 0..clock.Frames, whose second differences are kept as far as
/// the marks allow. end: where a path leads that is not to the goal.
SpanWarp LaySpan(const SpanRequest& request, const SpanClock& clock, const std::vector<Vec3>& path,
                 const Vec3& end, bool toGoal);

/// In the last second before a rest it sinks evenly, no faster than the goal allows, and slows down
/// over the CushionTime. The height that this leaves over is spread over the rest of the span.
/// positions: the span's frames, before and after. Leaves alone what does not land.
void BringDown(const SpanRequest& request, const SegmentLibrary& library, SpanWarp& span,
               std::vector<Vec3>& positions);

} // namespace waft
