// SPDX-License-Identifier: BSD-3-Clause
// Who goes where of very many single rows that any object may fulfil: one row after the other.
#pragma once

#include "Planning/TargetStops.h"

#include <cstddef>
#include <vector>

namespace waft
{

/// By target the index of an object, NoObject where none can come in time. Targets take their turns
/// as they are listed, in order of time: each gets the object that comes by the shortest of the
/// legs that can be flown, with as few in haste as may be. stops: the positions that each object is
/// fixed to, in order of time, its start first.
std::vector<std::size_t> CoverInTurn(const std::vector<MotionObject>& objects,
                                     std::vector<std::vector<Stop>> stops,
                                     const std::vector<TargetStops>& targets,
                                     const SpeedLimit& limit);

} // namespace waft
