// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/FloorContact.h"

#include <cmath>

namespace waft
{
namespace
{
constexpr int Halvings = 30;
constexpr int MostPushes = 8;
constexpr double TouchSlack = 1e-9;     // m
constexpr double OnTheFloor = 1e-5;     // m: points this near are touched
constexpr double RockingDamping = 15.0; // 1/s
constexpr double Softness = 0.02; // of the body's reach: points this near to the lowest carry, too

/// Height of the lowest point [m].
double Lowest(const Floor& floor, const Quat& orientation)
{
  const Vec3 up = orientation.conjugate() * floor.Normal;
  double lowest = 1e300;
  for (const Vec3& point : *floor.Points)
  {
    lowest = std::min(lowest, floor.Height + up.dot(point));
  }
  return lowest;
}

/// The least part of the turn that lays the body flat, on the nearer side, by which all is above,
/// or as much of it as there is room for.
Quat LeastTurnUp(const Floor& floor, const Quat& orientation, const ContactRoom& room)
{
  const Mat3 axes = orientation.toRotationMatrix();
  const double side = axes.col(2).dot(floor.Normal) < 0.0 ? -1.0 : 1.0;
  const Vec3 flat = LogMap(LeastTurn(axes.col(2), side * floor.Normal, axes.col(0)));
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < Halvings; ++i)
  {
    const double middle = 0.5 * (low + high);
    const bool above = Lowest(floor, ExpMap(middle * flat) * orientation) >= -TouchSlack;
    (above ? high : low) = middle;
  }
  const auto isFar = [&](double part)
  { return LogMap(ExpMap(part * flat) * orientation * room.Since.conjugate()).norm() > room.Most; };
  if (floor.Lifts && isFar(high))
  {
    low = 0.0;
    for (int i = 0; i < Halvings; ++i)
    {
      const double middle = 0.5 * (low + high);
      (isFar(middle) ? high : low) = middle;
    }
    high = low;
  }
  return ExpMap(high * flat);
}

/// Pushes the touched point that turns into the floor fastest until it no longer does; false when
/// there is none.
bool Push(const FlightBody& body, const Floor& floor, FlightState& state)
{
  const Vec3 omega = state.AngularVelocity(body);
  Vec3 arm = Vec3::Zero();
  double speed = -1e-9;
  for (const Vec3& point : *floor.Points)
  {
    const Vec3 at = state.Orientation * point;
    if (floor.Height + floor.Normal.dot(at) > OnTheFloor)
    {
      continue;
    }
    const double here = floor.Normal.dot(omega.cross(at));
    if (here < speed)
    {
      speed = here;
      arm = at;
    }
  }
  const Vec3 moment = arm.cross(floor.Normal);
  const Vec3 inBody = state.Orientation.conjugate() * moment;
  const double yielding = inBody.dot(body.InverseInertia * inBody);
  if (!(yielding > 0.0))
  {
    return false;
  }
  state.AngularMomentum -= speed / yielding * moment;
  return true;
}
} // namespace

bool TouchFloor(const FlightBody& body, const Floor& below, FlightState& state,
                const ContactRoom& room)
{
  Floor floor = below;
  floor.Height += below.Give;
  if (Lowest(floor, state.Orientation) >= -TouchSlack)
  {
    return false;
  }
  const Quat turn = LeastTurnUp(floor, state.Orientation, room);
  state.Orientation = (turn * state.Orientation).normalized();
  state.AngularMomentum = turn * state.AngularMomentum; // the body is turned as it moves
  for (int i = 0; i < MostPushes && Push(body, floor, state); ++i)
  {
  }
  return true;
}

bool PressOnFloor(const FlightBody& body, const Floor& floor, double time, FlightState& state)
{
  const double lowest = Lowest(floor, state.Orientation);
  if (!(floor.Weight > 0.0) || lowest > 0.0)
  {
    return false;
  }
  const double soft = Softness * body.Reach;
  const Vec3 up = state.Orientation.conjugate() * floor.Normal;
  Vec3 arm = Vec3::Zero();
  double all = 0.0;
  for (const Vec3& point : *floor.Points)
  {
    const double share = 1.0 - (floor.Height + up.dot(point) - lowest) / soft;
    if (share > 0.0)
    {
      arm += share * point;
      all += share;
    }
  }
  arm = state.Orientation * Vec3(arm / all);
  state.AngularMomentum += time * floor.Weight * arm.cross(floor.Normal);
  state.AngularMomentum *= std::exp(-RockingDamping * time);
  return true;
}

} // namespace waft
