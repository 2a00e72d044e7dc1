// SPDX-License-Identifier: BSD-3-Clause
// Field data of a scene, objects, constraints, the report, vortices.
#pragma once

#include "Base/ForceFields.h"
#include "Base/Motion.h"
#include "Base/Result.h"
#include "Base/Types.h"

#include <vector>

class vtkDataObject;
class vtkPolyData;
class vtkTable;

namespace waft
{

/// Field data `Bounds`, `NumberOfFrames`, `FramesPerSecond`, `AirDensity`, `Seed`.
void SceneInfoToFieldData(const SceneInfo& info, vtkDataObject* data);
/// What is absent keeps the value that info has. Fails on an empty volume, frames or rate.
Result SceneInfoFromFieldData(vtkDataObject* data, SceneInfo& info);

void ObjectsToPolyData(const std::vector<MotionObject>& objects, const SceneInfo& info,
                       vtkPolyData* data);
/// Needs `ObjectId`; the other arrays have the defaults of MotionObject. Ids must differ.
Result ObjectsFromPolyData(vtkPolyData* data, std::vector<MotionObject>& objects);

void ConstraintsToPolyData(const std::vector<Constraint>& constraints, const SceneInfo& info,
                           vtkPolyData* data);
/// Needs `ObjectId`, `Frame`, `Kind` and `Value`; the other arrays have the defaults of Constraint
/// (`Row`: the vertex's number). Fails on an unknown kind or a frame outside the time line.
Result ConstraintsFromPolyData(vtkPolyData* data, const Timeline& time,
                               std::vector<Constraint>& constraints);

/// One line per row of the report; Kind and Status as text.
void ReportToTable(const std::vector<ReportRow>& report, const SceneInfo& info, vtkTable* table);

void VorticesToPolyData(const std::vector<Vortex>& vortices, const SceneInfo& info,
                        vtkPolyData* data);
/// Needs 2-point line cells with `Strength`, `CenterTime`, `Duration`, `CoreRadius`.
Result VorticesFromPolyData(vtkPolyData* data, std::vector<Vortex>& vortices);

} // namespace waft
