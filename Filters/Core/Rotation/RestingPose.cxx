// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/RestingPose.h"

#include "Rotation/RigidBody.h"

#include <Eigen/LU>

#include <cmath>

namespace waft
{
namespace
{
constexpr double ContactDistance = 1e-9; // m: a vertex this near to the surface lies on it
constexpr int MostDrops = 40;
constexpr double LargestLean = 0.5; // rad, in all
constexpr double TurnStep = 0.25;   // rad, between two headings that are tried
constexpr int MostTurns = 6;        // either way

class Layer
{
public:
  Layer(const TriangleMesh& mesh, const ObstacleSet& obstacles, double frame, const Vec3& center,
        double mostShift) :
    Mesh(mesh),
    Obstacles(obstacles), Frame(frame), Center(center), MostShift(mostShift)
  {
  }

  /// Moves the centre until the lowest vertex touches; the depth is what is left over.
  RestingPose Settle(const Quat& q) const
  {
    RestingPose pose;
    pose.Orientation = q;
    double gap = this->Gap(q, 0.0, 1e30);
    if (gap > this->MostShift)
    {
      return pose; // it hangs in the air
    }
    for (int step = 0; step < MostDrops && std::abs(gap) > ContactDistance; ++step)
    {
      const double next = std::clamp(pose.Shift - gap, -this->MostShift, this->MostShift);
      if (next == pose.Shift)
      {
        break;
      }
      pose.Shift = next;
      gap = this->Gap(q, pose.Shift, 1e30);
    }
    if (gap < 0.0 && gap > -ContactDistance && pose.Shift + ContactDistance <= this->MostShift)
    {
      pose.Shift += ContactDistance;
      gap = 0.0;
    }
    pose.Depth = std::max(-gap, 0.0);
    return pose;
  }

  /// The normal of the plane, by least squares, through the surface straight below the vertices.
  Vec3 MeanNormal(const Quat& q, const Vec3& fallback) const
  {
    Mat3 moments = Mat3::Zero();
    Vec3 right = Vec3::Zero();
    for (const Vec3& point : this->Mesh.Points)
    {
      const Vec3 r = q * point;
      SurfaceHit hit;
      if (this->Obstacles.SurfaceBelow(this->Center + r + this->MostShift * Vec3::UnitZ(),
                                       this->Frame, hit))
      {
        const Vec3 row(r.x(), r.y(), 1.0);
        moments += row * row.transpose();
        right += (hit.Point.z() - this->Center.z()) * row;
      }
    }
    const Eigen::FullPivLU<Mat3> solver(moments);
    if (!solver.isInvertible())
    {
      return fallback;
    }
    const Vec3 plane = solver.solve(right);
    return Vec3(-plane.x(), -plane.y(), 1.0).normalized();
  }

  /// Leans the body, raised as far as it may be, until it clears the surface or no lean clears
  /// more: a search by steps that are halved where none helps.
  RestingPose Lean(const RestingPose& from) const
  {
    Vec3 lean = Vec3::Zero();
    const auto leaning = [&](const Vec3& v) { return (ExpMap(v) * from.Orientation).normalized(); };
    double gap = this->Gap(leaning(lean), this->MostShift, 0.0);
    for (double step = 0.16; step > 2e-3 && gap < 0.0;)
    {
      Vec3 best = lean;
      for (int way = 0; way < 8; ++way)
      {
        const double angle = 0.25 * way * std::acos(-1.0);
        const Vec3 next = lean + step * Vec3(std::cos(angle), std::sin(angle), 0.0);
        const double there =
          next.norm() > LargestLean ? -1e30 : this->Gap(leaning(next), this->MostShift, 0.0);
        if (there > gap)
        {
          gap = there;
          best = next;
        }
      }
      step = best == lean ? 0.5 * step : step;
      lean = best;
    }
    const RestingPose leant = this->Settle(leaning(lean));
    return leant.Depth < from.Depth ? leant : from;
  }

private:
  /// Least signed distance of a vertex [m], at most the limit.
  double Gap(const Quat& q, double shift, double limit) const
  {
    double least = limit;
    for (const Vec3& point : this->Mesh.Points)
    {
      const Vec3 r = q * point;
      const double d = this->Obstacles.SignedDistance(this->Center + r + shift * Vec3::UnitZ(),
                                                      this->Frame, least);
      least = std::min(least, d);
    }
    return least;
  }

  const TriangleMesh& Mesh;
  const ObstacleSet& Obstacles;
  double Frame;
  Vec3 Center;
  double MostShift;
};

/// The pose as it lies on a plane of this normal, or on one through what is below, or leaning.
RestingPose LayAlong(const Layer& layer, const Vec3& normal, const Quat& lying)
{
  RestingPose best = layer.Settle(lying);
  if (best.Depth > ContactDistance)
  {
    const Quat lean = LeastTurn(normal, layer.MeanNormal(lying, normal), Vec3::UnitX());
    const RestingPose fitted = layer.Settle((lean * lying).normalized());
    for (const RestingPose& pose : { fitted, layer.Lean(fitted), layer.Lean(best) })
    {
      best = pose.Depth < best.Depth ? pose : best;
    }
  }
  return best;
}
} // namespace

RestingPose LayDown(const TriangleMesh& mesh, const ObstacleSet& obstacles, double frame,
                    const Vec3& center, const Vec3& normal, const Quat& lying, double mostShift,
                    bool mayTurn)
{
  const Layer layer(mesh, obstacles, frame, center, mostShift);
  RestingPose best = LayAlong(layer, normal, lying);
  for (int i = 1; mayTurn && i <= 2 * MostTurns && best.Depth > ContactDistance; ++i)
  {
    const double angle = (i % 2 == 1 ? TurnStep : -TurnStep) * ((i + 1) / 2);
    const RestingPose turned = LayAlong(layer, normal, ExpMap(angle * normal) * lying);
    best = turned.Depth < best.Depth ? turned : best;
  }
  return best;
}

} // namespace waft
