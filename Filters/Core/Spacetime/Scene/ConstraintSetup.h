// SPDX-License-Identifier: BSD-3-Clause
// What the rows of Constraints mean to the optimiser: fixed places, balls, linear rows, landings
// and how near to its plan a thing stays about its start and its rests.
#pragma once

#include "Spacetime/Scene/SpacetimeSetup.h"

#include <vector>

namespace waft
{

/// Judges the rows (into Report) and sets up those that bind. grounds: ids of obstacles that are
/// the floor of the gas. The objects' part of the setup must be there.
void SetUpConstraints(const SpacetimeInput& input, const std::vector<int>& grounds,
                      SpacetimeSetup& setup);

} // namespace waft
