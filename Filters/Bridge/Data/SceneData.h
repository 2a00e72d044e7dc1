// SPDX-License-Identifier: BSD-3-Clause
// Field data of a scene, and its objects.
#pragma once

#include "Base/Motion.h"
#include "Base/Result.h"
#include "Base/Types.h"

#include <string>
#include <vector>

class vtkDataObject;
class vtkFieldData;
class vtkPolyData;

namespace waft
{

/// Field data `Bounds`, `NumberOfFrames`, `FramesPerSecond`, `AirDensity`, `Seed`.
void SceneInfoToFieldData(const SceneInfo& info, vtkDataObject* data);
/// What is absent keeps the value that info has. Fails on an empty volume, frames or rate.
Result SceneInfoFromFieldData(vtkDataObject* data, SceneInfo& info);
Result SceneInfoFromFieldData(vtkFieldData* fields, SceneInfo& info);

/// Field data `Authored`: the part of a scene file that made this data (AuthoredScene); nothing is
/// added for an empty text.
void AuthoredToFieldData(const std::string& part, vtkDataObject* data);
/// An empty text where there is none or no data.
std::string AuthoredFromFieldData(vtkDataObject* data);

/// hasOwnIds: false says that whoever takes several makers' objects, appended, is to number them
/// (the array `ObjectIdGiven`).
void ObjectsToPolyData(const std::vector<MotionObject>& objects, const SceneInfo& info,
                       vtkPolyData* data, bool hasOwnIds = true);
/// Needs `ObjectId`; the other arrays have the defaults of MotionObject, but for
/// `OrientationGiven`: without it an `Orientation` that is there is given. Ids that are given must
/// differ. Objects whose `ObjectIdGiven` is 0 take, in their order, the least numbers that no given
/// id takes: makers that do not know of each other need not agree.
Result ObjectsFromPolyData(vtkPolyData* data, std::vector<MotionObject>& objects);

} // namespace waft
