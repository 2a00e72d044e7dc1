// SPDX-License-Identifier: BSD-3-Clause
// Closed triangle surfaces of simple solids, counter-clockwise seen from outside.
#pragma once

#include "Base/Mesh.h"

namespace waft
{

/// A box; a slab is one with a large side.
TriangleMesh MakeBox(const Box& box);

/// A sphere of latitude and longitude; its points lie on the sphere. At least 3 meridians and 2
/// parallels.
TriangleMesh MakeSphere(const Vec3& center, double radius, int meridians = 48, int parallels = 24);

/// A right cylinder with flat ends; the points of its side lie on the cylinder. At least 3 sides;
/// base and top differ.
TriangleMesh MakeCylinder(const Vec3& base, const Vec3& top, double radius, int sides = 48);

} // namespace waft
