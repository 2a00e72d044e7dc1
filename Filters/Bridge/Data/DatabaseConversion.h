// SPDX-License-Identifier: BSD-3-Clause
// The motion database as a data set of six named blocks.
//
//   Segments     vtkPolyData, one polyline a segment in its own frame, so that it can be looked at
//                  point data  ForceType, VortexId (index of the cell in Vortices, -1 none)
//                  cell data   Group, Simulation, MeanWind [m/s^2], Coefficients [m], as many
//                              components as the largest rank, the rest zero
//                  field data  that of a scene, Window, SettlingSpeed, TopSpeed
//   Basis        vtkTable, three rows a sample, group after group:
//                  Group, Rank, RelativeError, Mean [m], Basis (as many components as Coefficients)
//   Nodes        vtkTable: Group, Parent, Medoid (a segment), FirstChild, NumberOfChildren,
//                  NumberOfSegments, Radius [m]; those without a parent come first
//   Connections  vtkTable, one row a pair of nodes without a parent, `After` fastest: Before,
//   After,
//                  Cost, IsConnectible, Rotation (w, x, y, z), Translation [m]
//   Vortices     vtkPolyData as everywhere, in the frame and the time of their segment
//   Provenance   vtkTable of text: Key, Value
#pragma once

#include "Base/Result.h"
#include "Trajectory/Coverage.h"
#include "Trajectory/MotionDatabase.h"

#include <vector>

class vtkDataObject;
class vtkMultiBlockDataSet;
class vtkTable;

namespace waft
{

void DatabaseToMultiBlock(const MotionDatabase& database, vtkMultiBlockDataSet* data);

/// Every number comes back as it was, through ParaView's own .vtm writer and reader, too. The
/// points of Segments are not read: coefficients and basis give them. `Vortices` and `Provenance`
/// may be absent. Fails with the name of the
/// block and the array when something is missing or does not fit (MotionDatabase::Validate).
Result DatabaseFromMultiBlock(vtkMultiBlockDataSet* data, MotionDatabase& database);

/// Columns `Simulations`, `NewSegments`, `NewShare`.
void CoverageToTable(const std::vector<CoveragePoint>& coverage, vtkTable* table);

} // namespace waft
