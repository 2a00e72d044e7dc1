// SPDX-License-Identifier: BSD-3-Clause
// Shapes: a multi-block data set of named surfaces.
#pragma once

#include "Base/Result.h"
#include "Base/Shape.h"
#include "Base/Types.h"

#include <cstddef>
#include <string>
#include <vector>

class vtkFieldData;
class vtkMultiBlockDataSet;

namespace waft
{

/// Block i is shape i, by its name; field data `DragCoefficient`, `AreaDensity`, `Thickness`,
/// `SettlingSpeed`, `ClassId`, `Color`, `Texture`, `Authored`, of a painted one `Skin`, `SkinSize`.
void ShapesToMultiBlock(const std::vector<Shape>& shapes, const SceneInfo& info,
                        vtkMultiBlockDataSet* data);
/// Polygons are split into triangles; absent field data has the defaults of Shape. Fails on a block
/// that is no surface or has no triangle.
Result ShapesFromMultiBlock(vtkMultiBlockDataSet* data, std::vector<Shape>& shapes);
/// The same of what has to be flown: fails where there is none.
Result BodiesFromMultiBlock(vtkMultiBlockDataSet* data, std::vector<Shape>& shapes);
/// `Color`, `Tint`, `Opacity`, `Texture`, with a tuple a shape; where one has a skin `SkinSize`,
/// too, and `Skin`, all of them one after the other.
void LooksToFieldData(const std::vector<Shape>& shapes, vtkFieldData* fields);
/// The skin of a shape out of that; empty where it has none, or the arrays do not say whose it is.
std::string SkinOf(vtkFieldData* fields, std::size_t shape);

} // namespace waft
