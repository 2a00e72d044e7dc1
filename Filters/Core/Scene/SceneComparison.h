// SPDX-License-Identifier: BSD-3-Clause
// Whether what was read is what a scene has: numbers to a rounding, labels to the letter. Private
// to this library.
#pragma once

#include "Scene/Scene.h"

namespace waft
{

/// The surface and its texture coordinates, which are floats on their way through VTK.
bool IsSameBody(const Shape& a, const Shape& b);
/// Names may differ.
bool IsSameShape(const Shape& a, const Shape& b);
bool IsSameObject(const MotionObject& a, const MotionObject& b);
/// Numbers of rows and groups may differ, and, where `mindsObject` is false, objects.
bool IsSameRow(const Constraint& a, const Constraint& b, bool mindsObject);
/// Surface and motion, within 1e-9 m; ids may differ.
bool IsSameObstacle(const ObstacleMesh& a, const ObstacleMesh& b);
bool AreSameWinds(const Scene& a, const Scene& b);

} // namespace waft
