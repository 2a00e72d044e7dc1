// SPDX-License-Identifier: BSD-3-Clause
// A surface stops what would turn through it, while the body flies.
#pragma once

#include "Rotation/Flight.h"

#include <vector>

namespace waft
{

/// The surface nearest to a body's centre, as a plane, for the time of a frame.
struct Floor
{
  const std::vector<Vec3>* Points = nullptr; // of the body, in its axes
  Vec3 Normal = Vec3::UnitZ();
  double Height = 0.0; // m, of the centre above it
  double Rate = 0.0;   // m/s, at which the centre rises from it
};

/// Turns a body of which a point lies below the floor towards lying flat, on the nearer side, by
/// the least that lifts it, about its centre, which stays. The turning that drives touched points
/// further down is taken from it by pushes of the floor at them, without rebound or friction: its
/// energy never grows. Returns whether anything touched. Where the centre is too low for the flat
/// pose points stay below.
bool TouchFloor(const FlightBody& body, const Floor& floor, FlightState& state);

} // namespace waft
