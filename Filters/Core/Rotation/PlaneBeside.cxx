// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/PlaneBeside.h"

#include "Rotation/RigidBody.h"

#include <algorithm>

namespace waft
{
namespace
{
constexpr int Directions = 12;     // from the nearest plane's normal to either one of the body
constexpr double LeastGain = 1e-6; // m, by which another plane is worth while
constexpr double Rounding = 1e-9;  // m

/// m, of the body's centre on its way.
double CenterAbove(const SurfaceHit& plane, const PassingBody& body)
{
  return std::min((body.Center - plane.Point).dot(plane.Normal),
                  (body.Before - plane.Point).dot(plane.Normal));
}

/// m, of its lowest point.
double HeightAbove(const SurfaceHit& plane, const PassingBody& body)
{
  const Vec3 down = body.Orientation.conjugate() * plane.Normal;
  double lowest = 1e300;
  for (const Vec3& point : *body.Points)
  {
    lowest = std::min(lowest, down.dot(point));
  }
  return CenterAbove(plane, body) + lowest;
}
} // namespace

SurfaceHit PlaneBeside(const ObstacleSet& obstacles, const SurfaceHit& nearest,
                       const PassingBody& body)
{
  SurfaceHit best = nearest;
  double highest = HeightAbove(nearest, body);
  const Mat3 axes = body.Orientation.toRotationMatrix();
  for (const double side : { 1.0, -1.0 })
  {
    const Vec3 turn = LogMap(LeastTurn(nearest.Normal, side * axes.col(2), axes.col(0)));
    for (int i = 1; i <= Directions && highest < 0.0; ++i)
    {
      const Vec3 direction = ExpMap(static_cast<double>(i) / Directions * turn) * nearest.Normal;
      SurfaceHit plane;
      const double away = obstacles.SignedDistanceTo(
        nearest.ObstacleId, nearest.Point + body.Reach * direction, body.Frame, plane);
      // In a valley the other slope keeps nothing off this one.
      if (away < Rounding || (nearest.Point - plane.Point).dot(plane.Normal) > Rounding ||
          CenterAbove(plane, body) < 0.0)
      {
        continue;
      }
      const double height = HeightAbove(plane, body);
      if (height > highest + LeastGain)
      {
        highest = height;
        best = plane;
      }
    }
  }
  return best;
}

} // namespace waft
