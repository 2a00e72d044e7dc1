// SPDX-License-Identifier: BSD-3-Clause
// One target that any object may fulfil, as those see it who share targets out among objects.
#pragma once

#include "Base/Motion.h"
#include "Planning/Legs.h"

#include <cstddef>

namespace waft
{

/// The positions that one target asks for.
struct TargetStops
{
  Stop First, Last; // the same of a single row
  int ClassId = -1; // -1: any

  bool Suits(const MotionObject& object) const
  {
    return this->ClassId < 0 || this->ClassId == object.ClassId;
  }
};

/// In place of an object's index, for a target that none fulfils.
inline constexpr std::size_t NoObject = static_cast<std::size_t>(-1);

} // namespace waft
