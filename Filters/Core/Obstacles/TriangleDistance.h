// SPDX-License-Identifier: BSD-3-Clause
// Closest points of points, segments and triangles (Ericson, Real-Time Collision Detection, ch. 5).
#pragma once

#include "Base/Types.h"

namespace waft
{

/// The point of triangle (a, b, c) closest to p. A triangle without area is a segment or a point.
Vec3 ClosestOnTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Squared distance between the segments p0 p1 and q0 q1 [m^2]; either may be a point.
double SquaredDistanceOfSegments(const Vec3& p0, const Vec3& p1, const Vec3& q0, const Vec3& q1);

/// True when some point of the segment p0 p1 is nearer than radius to triangle (a, b, c), or the
/// segment crosses it.
bool SegmentNearTriangle(const Vec3& p0, const Vec3& p1, double radius, const Vec3& a,
                         const Vec3& b, const Vec3& c);

} // namespace waft
