// SPDX-License-Identifier: BSD-3-Clause
// Shapes: a multi-block data set of named surfaces.
#pragma once

#include "Base/Result.h"
#include "Base/Shape.h"
#include "Base/Types.h"

#include <vector>

class vtkFieldData;
class vtkMultiBlockDataSet;

namespace waft
{

/// Block i is shape i, by its name; field data `DragCoefficient`, `AreaDensity`, `Thickness`,
/// `SettlingSpeed`, `ClassId`, `Color`, `Texture`, `Authored`.
void ShapesToMultiBlock(const std::vector<Shape>& shapes, const SceneInfo& info,
                        vtkMultiBlockDataSet* data);
/// Polygons are split into triangles; absent field data has the defaults of Shape. Fails on a block
/// that is no surface or has no triangle.
Result ShapesFromMultiBlock(vtkMultiBlockDataSet* data, std::vector<Shape>& shapes);
/// The same of what has to be flown: fails where there is none.
Result BodiesFromMultiBlock(vtkMultiBlockDataSet* data, std::vector<Shape>& shapes);
/// `Color`, `Tint`, `Opacity`, `Texture`, with a tuple a shape.
void LooksToFieldData(const std::vector<Shape>& shapes, vtkFieldData* fields);

} // namespace waft
