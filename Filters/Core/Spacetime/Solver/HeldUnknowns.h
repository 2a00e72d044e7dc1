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
  bool IsPart = false;       // something is held
  std::vector<char> Objects; // [level frame * objects + object]
};

/// All at frames that are not free.
HeldUnknowns HoldUnknowns(const SpacetimeModel& model, const TimeLevel& level);

/// Takes what is held out of a direction.
void ClearHeld(const SpacetimeModel& model, const TimeLevel& level, const HeldUnknowns& held,
               StateVector& direction);

} // namespace waft
