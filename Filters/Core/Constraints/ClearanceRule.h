// SPDX-License-Identifier: BSD-3-Clause
// How far an object stays from what is around it: what checker, planner and optimiser ask.
#pragma once

#include "Base/Motion.h"

#include <algorithm>

namespace waft
{

/// For the centre of one object, all in one unit of length.
struct ClearanceRule
{
  double Radius = MotionObject().ClearanceRadius; // to obstacles, walls and ground
  double RestHeight = 0.0;                        // to the surface that it lands on or leaves

  ClearanceRule() = default;
  ClearanceRule(double radius, double restHeight) : Radius(radius), RestHeight(restHeight) {}
  ClearanceRule(const MotionObject& object) :
    ClearanceRule(object.ClearanceRadius, object.RestHeight)
  {
  }

  /// With a stage's own margin, negative for a tolerance. A surface that is landed on has none: an
  /// object would hover there until its rest.
  ClearanceRule With(double margin) const
  {
    return { std::max(0.0, this->Radius + margin), this->RestHeight };
  }

  /// From one surface, at a frame at which the object lands there or does not.
  double From(bool landsThere) const { return landsThere ? this->RestHeight : this->Radius; }
};

} // namespace waft
