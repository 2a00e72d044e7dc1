// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/Rolling.h"

#include "Rotation/RigidBody.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{
constexpr int MostRolls = 4096;   // faces that it rolls over: more than a round body has on its way
constexpr double Touching = 1e-8; // of the body's size: points this near to the plane carry
constexpr double Nudge = 1e-4;    // rad, off a balance
const double Pi = std::acos(-1.0);

/// Rolls a direction `up` of the body's own axes; the height of the centre is the largest -up . p.
class Roller
{
public:
  Roller(const std::vector<Vec3>& points, const Vec3& up) : Points(points), Up(up)
  {
    for (const Vec3& point : points)
    {
      this->Size = std::max(this->Size, point.norm());
    }
  }

  const Vec3& Direction() const { return this->Up; }

  /// To the next point or edge of the hull that touches; false when it stands.
  bool Step()
  {
    this->FindCarriers();
    Vec3 way = this->Steepest();
    if (way.norm() <= Touching * this->Size)
    {
      if (this->Stands())
      {
        return false;
      }
      way = this->OffBalance();
      this->Up = (this->Up + Nudge * way.normalized()).normalized();
      return true;
    }
    way.normalize();
    const double angle = this->AngleToNext(way);
    if (!(angle < 0.5 * Pi))
    {
      return false;
    }
    this->Up = (std::cos(angle) * this->Up + std::sin(angle) * way).normalized();
    return true;
  }

private:
  void FindCarriers()
  {
    double lowest = 1e300;
    for (const Vec3& point : this->Points)
    {
      lowest = std::min(lowest, this->Up.dot(point));
    }
    this->Carriers.clear();
    for (const Vec3& point : this->Points)
    {
      const double height = this->Up.dot(point);
      if (height <= lowest + Touching * this->Size)
      {
        this->Carriers.push_back(point - height * this->Up);
      }
    }
    this->Lowest = lowest;
  }

  /// The point nearest to the centre's foot of all between the carriers, seen from that foot: the
  /// centre falls fastest as `up` turns to it.
  Vec3 Steepest() const
  {
    if (this->Stands())
    {
      return Vec3::Zero();
    }
    Vec3 nearest = this->Carriers.front();
    for (std::size_t i = 0; i < this->Carriers.size(); ++i)
    {
      for (std::size_t j = i; j < this->Carriers.size(); ++j)
      {
        const Vec3& from = this->Carriers[i];
        const Vec3 along = this->Carriers[j] - from;
        const double length = along.squaredNorm();
        const double part = length > 0.0 ? std::clamp(-from.dot(along) / length, 0.0, 1.0) : 0.0;
        const Vec3 here = from + part * along;
        nearest = here.squaredNorm() < nearest.squaredNorm() ? here : nearest;
      }
    }
    return nearest;
  }

  /// The centre's foot is between three carriers or more.
  bool Stands() const
  {
    const Vec3 x = this->Up.unitOrthogonal();
    const Vec3 y = this->Up.cross(x);
    std::vector<double> angles;
    for (const Vec3& carrier : this->Carriers)
    {
      angles.push_back(std::atan2(carrier.dot(y), carrier.dot(x)));
    }
    std::sort(angles.begin(), angles.end());
    double gap = angles.front() + 2.0 * Pi - angles.back();
    for (std::size_t i = 1; i < angles.size(); ++i)
    {
      gap = std::max(gap, angles[i] - angles[i - 1]);
    }
    return this->Carriers.size() > 2 && gap < Pi - 1e-9;
  }

  /// Across the edge, or anywhere off the point, towards the z axis.
  Vec3 OffBalance() const
  {
    Vec3 edge = Vec3::Zero();
    for (const Vec3& carrier : this->Carriers)
    {
      edge = carrier.norm() > edge.norm() ? carrier : edge;
    }
    Vec3 off = Vec3::UnitZ() - this->Up.z() * this->Up;
    if (edge.norm() > Touching * this->Size)
    {
      const Vec3 across = this->Up.cross(edge).normalized();
      return off.dot(across) < 0.0 ? Vec3(-across) : across;
    }
    return off.norm() > Touching ? off : this->Up.unitOrthogonal();
  }

  double AngleToNext(const Vec3& way) const
  {
    double onward = 1e300; // of the carriers, that which stays lowest
    for (const Vec3& carrier : this->Carriers)
    {
      onward = std::min(onward, way.dot(carrier));
    }
    double angle = Pi;
    for (const Vec3& point : this->Points)
    {
      const double above = this->Up.dot(point) - this->Lowest;
      const double nearing = onward - way.dot(point);
      if (above > Touching * this->Size && nearing > 0.0)
      {
        angle = std::min(angle, std::atan2(above, nearing));
      }
    }
    return angle;
  }

  const std::vector<Vec3>& Points;
  Vec3 Up;
  double Size = 0.0;
  double Lowest = 0.0;
  std::vector<Vec3> Carriers; // seen from the centre's foot on the plane
};
} // namespace

double StandingHeight(const std::vector<Vec3>& points, const Quat& orientation, const Vec3& normal)
{
  const Vec3 up = orientation.conjugate() * normal;
  double lowest = 0.0;
  for (const Vec3& point : points)
  {
    lowest = std::min(lowest, up.dot(point));
  }
  return -lowest;
}

Quat RollDown(const std::vector<Vec3>& points, const Quat& orientation, const Vec3& normal)
{
  Quat turned = orientation;
  Roller roller(points, orientation.conjugate() * normal);
  for (int step = 0; step < MostRolls && roller.Step(); ++step)
  {
    turned = (LeastTurn(turned * roller.Direction(), normal, Vec3::UnitX()) * turned).normalized();
  }
  return turned;
}

} // namespace waft
