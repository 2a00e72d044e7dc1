// SPDX-License-Identifier: BSD-3-Clause
// The trees that grew while a motion was planned, its takes, and the guides it follows.
#pragma once

#include "Base/Result.h"
#include "Base/Types.h"
#include "Planning/Takes.h"

#include <vector>

class vtkPolyData;
class vtkTable;

namespace waft
{

/// Cell data `ObjectId`, `Span` (index of the flight along the object's time line), `Tree` (0 from
/// the start, 1 from the goal), `Parent` (a cell, -1 a root), `Segment` (of the database), `Cost`
/// (of the connection to the parent), `Frame` (of the free end).
void TreesToPolyData(const std::vector<TreeBranch>& trees, const SceneInfo& info,
                     vtkPolyData* data);

/// One line a take: `Take`, `Seed`, `Met` and `Rows` (of the report), `CurvatureDistance` and
/// `AccelerationDistance` (Kolmogorov-Smirnov, to the database), `Score` (less is better).
void TakesToTable(const std::vector<TakeScore>& takes, const SceneInfo& info, vtkTable* table);

/// One line a flight to a mark: `ObjectId`, `Row`, `Target`, `Frame`, `Reached`, `RetimingFactor`,
/// `Cost`, `Branches`, `Seconds`.
void FlightsToTable(const std::vector<FlightRow>& flights, const SceneInfo& info, vtkTable* table);
/// One line an object: `ObjectId`, `Rows`, `Met`, `Status`, `Cost`, `Branches`, `Seconds`,
/// `Planned`, `Message`.
void ObjectRowsToTable(const std::vector<ObjectRow>& rows, const SceneInfo& info, vtkTable* table);

/// One guide a line cell, for the object that its cell data `ObjectId` names; without that array
/// the k-th line is for the object of id k. No data: none.
Result GuidesFromPolyData(vtkPolyData* data, std::vector<Guide>& guides);

} // namespace waft
