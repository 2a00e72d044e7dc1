// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/GroundCushion.h"

namespace waft
{
namespace
{

// Of the height from which it brakes.
constexpr double Strength = 0.25;
constexpr double CoreShare = 0.25; // where it is stiffest

struct Surface
{
  double Distance = 0.0;
  Vec3 Normal = Vec3::UnitZ();
  Mat3 Curvature = Mat3::Zero(); // second derivatives of the distance
};

Surface ObstacleSurface(const SpacetimeModel& model, int frame, const Vec3& position)
{
  Surface surface;
  surface.Distance = model.Obstacles.Evaluate(position, frame, surface.Normal, surface.Curvature);
  return surface;
}

} // namespace

CushionForce LandingCushion(const SpacetimeModel& model, int frame, double step, std::size_t object,
                            const Vec3& position, const Vec3& velocity)
{
  CushionForce force;
  const std::uint8_t flag = model.Flag(frame, object);
  const double brake = model.BrakeHeights[object];
  if (!(flag & (LandsOnFloor | LandsOnObstacle)) || (flag & LiftsOff) || brake <= 0.0)
  {
    return force;
  }
  Surface surface;
  surface.Distance = position.z();
  if (!(flag & LandsOnFloor))
  {
    surface = ObstacleSurface(model, frame, position);
  }
  const double height = surface.Distance - model.RestHeights[object];
  const double core = CoreShare * brake;
  const double free =
    Strength * model.SettlingSlip(object) * brake / (height * height + core * core);
  // As a step implicit in this drag would have it. An explicit one takes more than all of the speed
  // and throws the object back.
  const double rate = free / (1.0 + step * free);
  const double slope = -2.0 * height / (height * height + core * core) * rate * rate / free;
  const Vec3& n = surface.Normal;
  const double approach = velocity.dot(n);
  force.Acceleration = -rate * approach * n;
  force.ByVelocity = -rate * n * n.transpose();
  force.ByPosition = -n * (slope * approach * n + rate * surface.Curvature * velocity).transpose() -
                     rate * approach * surface.Curvature;
  return force;
}

} // namespace waft
