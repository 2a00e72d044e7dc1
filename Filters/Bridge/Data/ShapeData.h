// SPDX-License-Identifier: BSD-3-Clause
// Shapes: a multi-block data set of named surfaces.
#pragma once

#include "Base/Motion.h"
#include "Base/Result.h"
#include "Base/Shape.h"
#include "Base/Types.h"

#include <vector>

class vtkMultiBlockDataSet;
class vtkPolyData;

namespace waft
{

/// Block i is shape i, by its name; field data `DragCoefficient`, `AreaDensity`, `Thickness`,
/// `SettlingSpeed`, `ClassId`, `Color`, `Texture`, `Authored`.
void ShapesToMultiBlock(const std::vector<Shape>& shapes, const SceneInfo& info,
                        vtkMultiBlockDataSet* data);
/// Polygons are split into triangles; absent field data has the defaults of Shape. Fails on a block
/// that is no surface or has no triangle.
Result ShapesFromMultiBlock(vtkMultiBlockDataSet* data, std::vector<Shape>& shapes);

/// Gives objects the array `ShapeDigest` of their one body.
void NameShape(const Shape& shape, vtkPolyData* objects);
/// Turns `ShapeDigest`, where objects have it, into `ShapeId`, the place of that body in `shapes`.
/// Fails when it is not among them.
Result FindNamedShapes(const std::vector<Shape>& shapes, vtkPolyData* data,
                       std::vector<MotionObject>& objects);

} // namespace waft
