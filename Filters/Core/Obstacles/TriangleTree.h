// SPDX-License-Identifier: BSD-3-Clause
// One triangle surface in a CGAL AABB tree: closest point, swept ball, vertical line.
#pragma once

#include "Base/Mesh.h"
#include "Base/Types.h"

#include <array>
#include <limits>
#include <memory>
#include <vector>

namespace waft
{

/// Where a vertical line passes through the surface.
struct VerticalCrossing
{
  double Z = 0.0; // m
  int Triangle = -1;
  bool Upwards = false; // the triangle faces upwards: going up, the line leaves the solid here
};

using TriangleCorners = std::array<Vec3, 3>;

/// Whether two triangles have a point in common, by exact predicates.
bool TrianglesMeet(const TriangleCorners& a, const TriangleCorners& b);

/// Queries are const and may run from many threads at once.
class TriangleTree
{
public:
  /// For Crossings and IsInside the surface must be closed and consistently oriented
  /// (RepairSurface).
  explicit TriangleTree(const TriangleMesh& mesh);
  ~TriangleTree();
  TriangleTree(TriangleTree&&) noexcept;
  TriangleTree& operator=(TriangleTree&&) noexcept;

  const Box& Bounds() const;
  /// Outward unit normal; zero for a triangle without area.
  Vec3 Normal(int triangle) const;

  struct Closest
  {
    double SquaredDistance = std::numeric_limits<double>::infinity(); // m^2
    Vec3 Point = Vec3::Zero();
    int Triangle = -1; // -1: nothing nearer than the limit
  };
  /// The closest point that is nearer than sqrt(limit2).
  Closest ClosestPoint(const Vec3& x,
                       double limit2 = std::numeric_limits<double>::infinity()) const;

  /// True when some point of the segment a b is nearer than radius to the surface, or crosses it.
  bool IsSegmentNear(const Vec3& a, const Vec3& b, double radius) const;

  /// All crossings of the vertical line through (x, y), from below to above. Which triangles are
  /// crossed is decided exactly (the line is shifted by an infinitesimal, so that it never meets an
  /// edge or a vertex): entries and exits alternate on every closed surface.
  std::vector<VerticalCrossing> Crossings(double x, double y) const;

  /// Exact but for the rounding of the crossings' heights.
  bool IsInside(const Vec3& x) const;

private:
  struct Internals;
  std::unique_ptr<Internals> Impl;
};

} // namespace waft
