// SPDX-License-Identifier: BSD-3-Clause
// Which objects come near to each other, and how far apart they keep there.
#pragma once

#include "Air/Drift/BodyProblem.h"
#include "Base/Parallel.h"
#include "Constraints/KeptDistances.h"

#include <vector>

namespace waft
{

/// Two bodies, A before B, near to each other at a frame.
struct DriftContact
{
  int Frame = 0;
  std::size_t A = 0, B = 0;
  double Kept = 0.0; // how far apart they keep there [m]
};

/// What bodies keep, by what holds them as their touch-downs and lift-offs are set.
KeptDistances KeptBy(const std::vector<BodyProblem>& bodies, double framesPerSecond);

/// All pairs that are nearer to each other than they keep, or farther by up to `margin` of what
/// they need; in the order of frames, of A and of B.
std::vector<DriftContact> FindContacts(const KeptDistances& kept,
                                       const std::vector<std::vector<Vec3>>& paths, double margin,
                                       const ParallelFor& parallel);

} // namespace waft
