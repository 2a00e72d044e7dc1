// SPDX-License-Identifier: BSD-3-Clause
// A surface stops what would turn through it, while the body flies.
#pragma once

#include "Rotation/Flight.h"

#include <limits>
#include <vector>

namespace waft
{

/// The surface nearest to a body's centre, as a plane, for the time of a frame.
struct Floor
{
  const std::vector<Vec3>* Points = nullptr; // of the body, in its axes
  Vec3 Normal = Vec3::UnitZ();
  double Height = 0.0;   // m, of the centre above it
  double Rate = 0.0;     // m/s, at which the centre rises from it
  double Give = 0.0;     // m, by which the floor may lift the centre before it turns the body
  double GiveRate = 0.0; // m/s
  double Weight = 0.0;   // N, that presses a body on it which touches; 0: the path carries it
  bool Lifts = false;    // it may lift the centre by more than Give, so that it turns by less

  /// As it is later [s].
  Floor After(double time) const
  {
    Floor later = *this;
    later.Height += time * this->Rate;
    later.Give += time * this->GiveRate;
    return later;
  }
};

/// How far a floor that Lifts may turn a body.
struct ContactRoom
{
  Quat Since = Quat::Identity(); // it is no farther turned than Most from this pose
  double Most = std::numeric_limits<double>::infinity(); // rad
};

/// Turns a body of which a point lies below the floor towards lying flat, on the nearer side, by
/// the least that lifts it, about its centre, which stays. The turning that drives touched points
/// further down is taken from it by pushes of the floor at them, without rebound or friction: its
/// energy never grows. Returns whether anything touched. Where the centre is too low for the flat
/// pose points stay below. A point that is below by no more than the floor's Give is left there:
/// the centre is lifted; so is what a floor that Lifts has no room to turn.
bool TouchFloor(const FlightBody& body, const Floor& floor, FlightState& state,
                const ContactRoom& room = {});

/// For a time [s] the weight presses a body of which a point lies below the floor on its lowest
/// points, so that it tips over and rocks about what carries it, and the air that is pressed from
/// under it dampens that. Returns whether it touches.
bool PressOnFloor(const FlightBody& body, const Floor& floor, double time, FlightState& state);

} // namespace waft
