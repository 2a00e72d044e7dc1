// SPDX-License-Identifier: BSD-3-Clause
// What is told of a flight as JSON.
#pragma once

#include "Base/Effort.h"
#include "Base/Types.h"
#include "Chain/Motion.h"
#include "Scene/SceneNode.h"

#include <vector>

class vtkPolyData;
class vtkTable;

namespace waft
{

/// What of report.json follows from a motion: `time`, `energy`, `dynamics`, `forces`,
/// `fieldsExplained`, `fit`, `settled`, `agreement`, `free`. poses and convergence: as they are
/// written.
SceneJson MotionAsJson(const SceneInfo& info, const Motion& motion, vtkPolyData* poses,
                       vtkTable* convergence);
/// seconds, processorSeconds, threadSeconds, peakMemoryMB.
SceneJson AsJson(const Effort& effort);
/// What planning came to, an entry an object.
SceneJson PlannedAsJson(const std::vector<ObjectRow>& rows);
/// An object a row, all texts.
SceneJson RowsAsJson(vtkTable* table);

} // namespace waft
