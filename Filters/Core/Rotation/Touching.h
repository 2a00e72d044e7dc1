// SPDX-License-Identifier: BSD-3-Clause
// A surface stops what would turn through it, while the body flies.
#pragma once

#include "Rotation/Flight.h"

#include <vector>

namespace waft
{

/// The surface nearest to a body's centre, as a plane.
struct Floor
{
  Vec3 Normal = Vec3::UnitZ();
  double Height = 0.0; // m, of the centre above it
  double Rate = 0.0;   // m/s, at which the centre rises from it
};

/// Turns a body of which a point (body axes) lies below the floor until none does: each time the
/// lowest point is turned up about the centre, which stays. What drove the points down is taken
/// from the angular momentum by pushes of the floor at them, without rebound or friction. Returns
/// whether anything touched. Where the centre is too low for any pose, points stay below.
bool TouchFloor(const FlightBody& body, const std::vector<Vec3>& points, const Floor& floor,
                FlightState& state);

} // namespace waft
