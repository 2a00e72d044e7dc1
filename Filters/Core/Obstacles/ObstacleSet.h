// SPDX-License-Identifier: BSD-3-Clause
// Closed triangle surfaces as obstacles: distance, swept clearance, the surface below a point.
#pragma once

#include "Base/Mesh.h"
#include "Base/Result.h"
#include "Base/Types.h"

#include <memory>
#include <vector>

namespace waft
{

struct SurfaceHit
{
  int ObstacleId = -1;
  Vec3 Point = Vec3::Zero();
  Vec3 Normal = Vec3::UnitZ(); // unit, outwards
};

/// Obstacles in CGAL AABB trees, one per obstacle, so that a moving one only shifts the query. All
/// queries are const and may run from many threads at once.
class ObstacleSet
{
public:
  ObstacleSet();
  ~ObstacleSet();
  ObstacleSet(ObstacleSet&&) noexcept;
  ObstacleSet& operator=(ObstacleSet&&) noexcept;

  /// Fails when a surface is not closed (an edge that does not belong to exactly two triangles is
  /// named), cuts or touches itself, is empty, holds a number that is not finite, or when two
  /// obstacles have one id; the message names the obstacle and the place. Different obstacles may
  /// touch or overlap. Inside-out surfaces and single triangles are turned, connected component by
  /// component; a component inside an odd number of others of its obstacle bounds a cavity. On
  /// failure the set is left as it was.
  Result Build(std::vector<ObstacleMesh> obstacles);

  bool IsEmpty() const;
  bool HasMoving() const;
  const std::vector<ObstacleMesh>& Obstacles() const;
  /// The one of an id, or null.
  const ObstacleMesh* Find(int obstacleId) const;

  /// Signed distance to the nearest obstacle [m], negative inside; at most `limit` (a query that
  /// needs no more than the limit is cheaper). `ignored`: the id of an obstacle left out.
  double SignedDistance(const Vec3& x, double frame, double limit = 1e30, int ignored = -1) const;
  /// The same with the closest point and the normal there: the gradient of the signed distance, or
  /// on the surface itself that of the face. Of nothing within the limit the hit's ObstacleId is
  /// -1.
  double SignedDistance(const Vec3& x, double frame, double limit, SurfaceHit& hit,
                        int ignored = -1) const;
  /// The same without a limit; 1e30 without obstacles.
  double SignedDistance(const Vec3& x, double frame, SurfaceHit& hit, int ignored = -1) const
  {
    return this->SignedDistance(x, frame, 1e30, hit, ignored);
  }
  /// The same to one obstacle alone; the limit when there is none of this id.
  double SignedDistanceTo(int obstacleId, const Vec3& x, double frame, double limit,
                          SurfaceHit& hit) const;
  double SignedDistanceTo(int obstacleId, const Vec3& x, double frame, SurfaceHit& hit) const
  {
    return this->SignedDistanceTo(obstacleId, x, frame, 1e30, hit);
  }

  /// True when a ball of this radius swept from a (at frameA) to b (at frameB) on a straight line
  /// at constant speed stays clear of every obstacle: no surface point nearer to the centre than
  /// the radius, no surface crossed, the centre outside. Exact up to rounding, moving obstacles
  /// included (their motion is straight between whole frames). A ball that only touches is clear.
  bool IsClear(const Vec3& a, double frameA, const Vec3& b, double frameB, double radius,
               int ignored = -1) const;

  /// The first surface straight below x at a frame. From a point inside an obstacle: the top of the
  /// solid that x is in (a target is never "inside" what it lands on); obstacles that overlap or
  /// touch there are one solid. The normal is the face's. False, and hit left as it was, when there
  /// is nothing below.
  bool SurfaceBelow(const Vec3& x, double frame, SurfaceHit& hit) const;

private:
  struct Internals;
  std::unique_ptr<Internals> Impl;
};

} // namespace waft
