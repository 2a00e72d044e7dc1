// SPDX-License-Identifier: BSD-3-Clause
// A flight as a .glb file.
#pragma once

#include "Base/Monitor.h"
#include "Base/Motion.h"
#include "Base/Result.h"
#include "Base/Shape.h"
#include "Base/Types.h"

#include <string>
#include <vector>

class vtkPolyData;

namespace waft
{

/// Poses of objects with the bodies of shapes, as WriteAnimationGlb has them; textures are read
/// from their files, and one that cannot be read is a warning. rows: whose frames keep their keys
/// when keys are thinned; null: none are. Fails on a pose without object or shape.
Result WriteAnimation(const std::string& fileName, vtkPolyData* poses,
                      const std::vector<MotionObject>& objects, std::vector<Shape> shapes,
                      vtkPolyData* rows, SceneInfo info, Monitor& monitor,
                      std::vector<std::string>& warnings);

} // namespace waft
