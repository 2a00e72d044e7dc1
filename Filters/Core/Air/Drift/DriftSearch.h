// SPDX-License-Identifier: BSD-3-Clause
// The best path of one body: from several starts, with several touch-downs and lift-offs.
#pragma once

#include "Air/Drift/BodyProblem.h"
#include "Base/Monitor.h"

#include <vector>

namespace waft
{

inline constexpr int DriftIterations = 60;
inline constexpr int FurtherIterations = 12; // where the air has changed little

/// How a path is looked for.
struct DriftSearch
{
  DriftWeights Weights;
  int Starts = 0;         // perturbed ones
  int Spread = 0;         // frames that it may lie before and after those between which it has to
  int Settling = 0;       // frames before that of its row, at the latest, that a body touches down
  int Step = 1;           // frames between touch-downs that are tried, and between lift-offs
  bool HasSolids = false; // in the air: what passes through an obstacle is worse than what does not
};

/// Touch-downs as late as they may be, lift-offs as the rows have them.
void SetLatestTouchDowns(const DriftSearch& search, BodyProblem& body);

/// The path with the least control is kept, with its touch-downs and lift-offs; that so far is
/// among them.
void SeekPath(const DriftSearch& search, const AirSampler& air, BodyProblem& body,
              std::vector<Vec3>& path, Monitor& monitor);

} // namespace waft
