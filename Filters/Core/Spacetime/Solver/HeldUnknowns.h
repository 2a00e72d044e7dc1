// SPDX-License-Identifier: BSD-3-Clause
// What of a level keeps its values while the rest is solved for.
#pragma once

#include "Spacetime/Model/StateVector.h"
#include "Spacetime/Model/TimeLevel.h"

#include <cstddef>
#include <vector>

namespace waft
{

struct HeldUnknowns
{
  bool IsPart = false;          // something is held
  std::vector<char> Objects;    // [level frame * objects + object]
  std::vector<std::size_t> Gas; // particles, at all frames
};

/// All at frames that are not free, and bodies that are not movable (by body; empty: all are).
HeldUnknowns HoldUnknowns(const SpacetimeModel& model, const TimeLevel& level,
                          const std::vector<char>& movable);

/// Takes what is held out of a direction.
void ClearHeld(const SpacetimeModel& model, const TimeLevel& level, const HeldUnknowns& held,
               StateVector& direction);

} // namespace waft
