// SPDX-License-Identifier: BSD-3-Clause
// A scene that loops, flown as one with a frame more, which is its first one again.
#pragma once

#include "Air/Run/AirState.h"

namespace waft
{

/// Of a scene of F frames one of F + 1: rows that close it (Constraints/LoopRows.h), obstacles and
/// wind that go on as they begin. Errors: as CloseLoop.
Result Unroll(const AssimilationInput& input, AssimilationInput& unrolled);
SolidsOn Unrolled(const SolidsOn& solids, int frames);
/// The first F frames of what came of it, in which each track has LoopTo; closing rows that are
/// not met become warnings. The air keeps its last field, the first one again.
void RollUp(const AssimilationInput& unrolled, AssimilationOutput& output);

/// Frames that the air of a loop is drawn for beyond its last; 0 of a scene that does not.
int FramesBeyond(const SceneInfo& unrolled, int frames);
/// Of an air of a loop's frames and some beyond a periodic one: in as many at the beginning what
/// would have come after the last one goes over to what came, at the rms between both.
void JoinEnds(int frames, const ParallelFor& parallel, HalfSeries& air);
/// Of an air that ends nearly as it begins: over its last second, so that it does.
void BendEnds(double framesPerSecond, const ParallelFor& parallel, HalfSeries& air);

/// Over its last 0.8 s each body's slips, poses and turning go over to those with which the object
/// begins that it goes on as; but of who lies.
void TurnIntoStarts(const AirContext& run, AirBodies& bodies);

} // namespace waft
