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

  /// Fails when a surface is not closed, cuts itself, is empty or holds a number that is not
  /// finite; the message names the obstacle. Different obstacles may touch or overlap. An
  /// inside-out surface is turned. On failure the set is left as it was.
  Result Build(std::vector<ObstacleMesh> obstacles);

  bool IsEmpty() const;
  bool HasMoving() const;
  const std::vector<ObstacleMesh>& Obstacles() const;

  /// Signed distance to the nearest obstacle [m], negative inside; at most `limit` (a query that
  /// needs no more than the limit is cheaper). `ignored`: the id of an obstacle left out.
  double SignedDistance(const Vec3& x, double frame, double limit = 1e30, int ignored = -1) const;
  /// The same, with the closest point and the outward normal there.
  double SignedDistance(const Vec3& x, double frame, SurfaceHit& hit, int ignored = -1) const;

  /// True when a ball of this radius swept from a (at frameA) to b (at frameB) on a straight line
  /// stays clear of every obstacle.
  bool IsClear(const Vec3& a, double frameA, const Vec3& b, double frameB, double radius,
               int ignored = -1) const;

  /// The first surface straight below x at a frame. From a point inside an obstacle: the top of the
  /// solid that x is in (a target is never "inside" what it lands on). False when there is nothing
  /// below.
  bool SurfaceBelow(const Vec3& x, double frame, SurfaceHit& hit) const;

private:
  struct Internals;
  std::unique_ptr<Internals> Impl;
};

} // namespace waft
