// SPDX-License-Identifier: BSD-3-Clause
// Mass properties of a thin shell and the geometry of turning.
#pragma once

#include "Base/Result.h"
#include "Base/Shape.h"
#include "Base/Types.h"

namespace waft
{

/// A shell of unit mass, spread evenly over its area.
struct ShellProperties
{
  double Area = 0.0;                    // m^2, of one side
  Vec3 Center = Vec3::Zero();           // m, centre of mass in the mesh's own axes
  Mat3 SecondMoment = Mat3::Zero();     // m^2, mean of (r - Center)(r - Center)^T over the area
  Mat3 InertiaPerMass = Mat3::Zero();   // m^2, about the centre; the thickness counts
  Mat3 NormalTensor = Mat3::Identity(); // mean of n n^T over the area, trace 1
  double BoundingRadius = 0.0;          // m, of the points about the body's origin
};

/// Fails when the mesh has no triangles or area, an index out of range or a number that is not
/// finite.
Result ComputeShellProperties(const Shape& shape, ShellProperties& properties);

/// The turn by the rotation vector v [rad].
Quat ExpMap(const Vec3& v);
/// The shortest rotation vector [rad] of q: its length is at most pi.
Vec3 LogMap(const Quat& q);
/// The rotation vector of q as its sign stands: continuous along continuous q, length below 2 pi.
Vec3 SignedLogMap(const Quat& q);
/// The least turn that takes unit vector a to unit vector b; opposite ones turn about `fallback`.
Quat LeastTurn(const Vec3& a, const Vec3& b, const Vec3& fallback);
Mat3 CrossMatrix(const Vec3& v);

} // namespace waft
