// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/Touching.h"

#include <cmath>

namespace waft
{
namespace
{
constexpr int MostTurns = 40;
constexpr double Rounding = 1e-9;   // m
constexpr double LeastLever = 1e-3; // of the arm: a point nearer to straight below has no side

/// From the centre to the lowest point, world [m].
Vec3 LowestArm(const std::vector<Vec3>& points, const Floor& floor, const Quat& orientation)
{
  const Vec3 down = orientation.conjugate() * floor.Normal;
  const Vec3* lowest = points.data();
  for (const Vec3& point : points)
  {
    lowest = down.dot(point) < down.dot(*lowest) ? &point : lowest;
  }
  return orientation * *lowest;
}

/// The least turn about the centre that lifts the end of an arm to the floor.
Quat TurnUp(const Vec3& arm, const Floor& floor, const FlightState& state)
{
  Vec3 axis = arm.cross(floor.Normal);
  double lever = axis.norm();
  if (lever < LeastLever * arm.norm())
  {
    // Straight below: along the body, whichever way.
    axis = (state.Orientation * Vec3::UnitX()).cross(floor.Normal);
    axis = axis.norm() > LeastLever ? axis : state.Orientation * Vec3::UnitY();
    lever = 0.0;
  }
  const double low = std::atan2(arm.dot(floor.Normal), lever);
  const double level = std::asin(std::clamp(-floor.Height / arm.norm(), -1.0, 1.0));
  return ExpMap((level - low) * axis.normalized());
}

/// Takes the speed at which the end of an arm goes into the floor from the body's turning.
void Stop(const FlightBody& body, const Vec3& arm, const Floor& floor, FlightState& state)
{
  const double speed = floor.Rate + floor.Normal.dot(state.AngularVelocity(body).cross(arm));
  if (speed >= 0.0)
  {
    return;
  }
  const Vec3 moment = arm.cross(floor.Normal);
  const Mat3 turn = state.Orientation.toRotationMatrix();
  const Vec3 inBody = turn.transpose() * moment;
  const double yielding = inBody.dot(body.InverseInertia * inBody);
  if (yielding > 0.0)
  {
    state.AngularMomentum -= speed / yielding * moment;
  }
}
} // namespace

bool TouchFloor(const FlightBody& body, const std::vector<Vec3>& points, const Floor& floor,
                FlightState& state)
{
  bool touched = false;
  for (int i = 0; i < MostTurns; ++i)
  {
    const Vec3 arm = LowestArm(points, floor, state.Orientation);
    if (floor.Height + arm.dot(floor.Normal) >= -Rounding)
    {
      break;
    }
    touched = true;
    const Quat turn = TurnUp(arm, floor, state);
    state.Orientation = (turn * state.Orientation).normalized();
    // The body is turned as it moves, its momenta with it.
    state.AngularMomentum = turn * state.AngularMomentum;
    Stop(body, turn * arm, floor, state);
  }
  return touched;
}

} // namespace waft
