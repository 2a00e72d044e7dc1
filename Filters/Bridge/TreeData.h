// SPDX-License-Identifier: BSD-3-Clause
// The trees that grew while a motion was planned: one polyline a branch.
#pragma once

#include "Base/Types.h"
#include "Planning/Planner.h"

#include <vector>

class vtkPolyData;

namespace waft
{

/// Cell data `ObjectId`, `Span` (place of the flight along the object's time line), `Tree` (0 from
/// the start, 1 from the goal), `Parent` (a cell, -1 a root), `Segment` (of the database), `Cost`
/// (of the connection to the parent), `Frame` (of the free end).
void TreesToPolyData(const std::vector<TreeBranch>& trees, const SceneInfo& info,
                     vtkPolyData* data);

} // namespace waft
