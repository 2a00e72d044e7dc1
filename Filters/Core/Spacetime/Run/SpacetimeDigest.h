// SPDX-License-Identifier: BSD-3-Clause
// Sums that tell problems apart: of a whole run, and of its parts.
#pragma once

#include "Base/StateArchive.h"
#include "Spacetime/Scene/SpacetimeSetup.h"

#include <cstdint>
#include <vector>

namespace waft
{

/// Everything that a run's result depends on, limits of time apart: two runs of one sum go the same
/// way on one machine.
std::uint64_t DigestOfRun(const SpacetimeInput& input, const SpacetimeOptions& options);

struct ProblemDigest
{
  std::uint64_t Shape = 0;   // which unknowns there are
  std::uint64_t Physics = 0; // what E is made of, tracks, rows and planned vortices apart
  std::uint64_t Vortices = 0;
  std::uint64_t SceneVortices = 0; // those that no track claims
  /// What is asked of an object at a frame: the planned place and every row that touches it
  /// [frame * objects + object].
  std::vector<std::uint64_t> Requests;
};
ProblemDigest DigestOfProblem(const SpacetimeInput& input, const SpacetimeOptions& options,
                              const SpacetimeSetup& setup);

} // namespace waft
