// SPDX-License-Identifier: BSD-3-Clause
// The spacetime optimisation of Shi et al. 2005, section 5: planned paths become the motion of
// things in one body of air, with the user's requirements met exactly.
#pragma once

#include "Base/Monitor.h"
#include "Base/Parallel.h"
#include "Base/Result.h"
#include "Spacetime/Model/SpacetimeOptions.h"
#include "Spacetime/Scene/SpacetimeInput.h"
#include "Spacetime/Scene/SpacetimeOutput.h"

#include <array>

namespace waft
{

/// Points of the lattice on which the wind is estimated and handed out; it spans the volume.
std::array<int, 3> WindLatticeDimensions(const Box& volume, const SpacetimeOptions& options);

/// Errors: tracks that are empty, not finite or of different lengths, constraints or tracks without
/// object, a volume too small for the gas, a MemoryLimit too low for windows of a few frames.
/// Stopped (by the monitor): the output holds the best feasible motion so far; so it does at the
/// TimeLimit, which is a warning.
Result RunSpacetime(const SpacetimeInput& input, const SpacetimeOptions& options,
                    const ParallelFor& parallel, Monitor& monitor, SpacetimeOutput& output);

} // namespace waft
