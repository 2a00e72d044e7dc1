// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Energy/LandingDamping.h"

#include <cmath>

namespace waft
{
namespace
{

// Shaped so that what settles in still air comes down as plans do: its speed falls as the root of
// the height, evenly in time, from about the height from which plans brake.
constexpr double Strength = 0.6;
constexpr double CoreFraction = 0.02; // of the height from which it brakes, where it is stiffest

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

DampingForce LandingDamping(const SpacetimeModel& model, int frame, double step, std::size_t object,
                            const Vec3& position, const Vec3& velocity)
{
  DampingForce force;
  const std::uint8_t flag = model.Flag(frame, object);
  if (!(flag & (LandsOnFloor | LandsOnObstacle)) || (flag & LiftsOff))
  {
    return force; // models in which nothing lands have no BrakeHeights
  }
  const double brake = model.BrakeHeights[object];
  if (brake <= 0.0)
  {
    return force;
  }
  Surface surface;
  surface.Distance = position.z();
  if (!(flag & LandsOnFloor))
  {
    surface = ObstacleSurface(model, frame, position);
  }
  const double height = surface.Distance - model.Clearances[object].RestHeight;
  const double r = height / brake;
  const double near = r * r + CoreFraction * CoreFraction;
  const double far = 1.0 + r * r * r * r;
  const double free = Strength * model.SettlingSlip(object) / brake / (std::pow(near, 0.25) * far);
  const double fall = -(0.5 * r / near + 4.0 * r * r * r / far) / brake;
  // As a step implicit in this drag would have it. An explicit one takes more than all of the speed
  // and throws the object back.
  const double rate = free / (1.0 + step * free);
  const double slope = fall * rate * rate / free;
  const Vec3& n = surface.Normal;
  const double approach = velocity.dot(n);
  force.Acceleration = -rate * approach * n;
  force.ByVelocity = -rate * n * n.transpose();
  force.ByPosition = -n * (slope * approach * n + rate * surface.Curvature * velocity).transpose() -
                     rate * approach * surface.Curvature;
  return force;
}

} // namespace waft
