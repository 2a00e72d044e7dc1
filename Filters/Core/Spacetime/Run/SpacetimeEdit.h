// SPDX-License-Identifier: BSD-3-Clause
// What an edit of some tracks or rows may move.
#pragma once

#include "Spacetime/Model/EditRegion.h"
#include "Spacetime/Run/SpacetimeWarmStart.h"
#include "Spacetime/Scene/SpacetimeSetup.h"

#include <vector>

namespace waft
{

/// Changed places (see ProblemDigest) with all frames within EditDuration, all bodies that come
/// within EditRadius of a changed object there, in the motion before or in `state`. Empty when
/// nothing changed.
EditRegion FindEditRegion(const SpacetimeWarmStart& before, const ProblemDigest& now,
                          const SpacetimeOptions& options, const SpacetimeSetup& setup,
                          const StateVector& state);

/// Brings the objects of `state`, a motion for the plan of `before`, to the plan and the rows of
/// `setup`: an object whose plan changed keeps its way from it; where a place is asked for that it
/// then misses, the frames within EditDuration come along, softly.
void MoveToPlan(const SpacetimeWarmStart& before, const SpacetimeOptions& options,
                const SpacetimeSetup& setup, StateVector& state);

} // namespace waft
