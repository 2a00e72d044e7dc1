// SPDX-License-Identifier: BSD-3-Clause
// Constraints, and what became of them.
#pragma once

#include "Base/Motion.h"
#include "Base/Result.h"
#include "Base/Types.h"
#include "Constraints/Constraint.h"

#include <map>
#include <utility>
#include <vector>

class vtkPolyData;
class vtkTable;

namespace waft
{

void ConstraintsToPolyData(const std::vector<Constraint>& constraints, const SceneInfo& info,
                           vtkPolyData* data);
/// Needs `ObjectId`, `Frame`, `Kind` and `Value`; the other arrays have the defaults of Constraint
/// (`Row`: the vertex's number). Fails on an unknown kind or a frame outside the time line.
Result ConstraintsFromPolyData(vtkPolyData* data, const Timeline& time,
                               std::vector<Constraint>& constraints);

/// What a report says of rows becomes their Status, which was the planner's.
template <class Line>
void TakeStatuses(const std::vector<Line>& report, std::vector<Constraint>& constraints)
{
  std::map<std::pair<int, int>, ConstraintStatus> statuses;
  for (const ReportRow& line : report)
  {
    statuses[{ line.Row, line.Target }] = line.Status;
  }
  for (Constraint& row : constraints)
  {
    const auto found = statuses.find({ row.Row, row.Target });
    row.Status = found != statuses.end() ? found->second : row.Status;
  }
}

/// Cell data `TouchDown` of tracks or poses: the frame from which a body lies to the end, asked for
/// or not; -1: it does not.
void AddTouchDowns(const std::vector<Constraint>& constraints, vtkPolyData* tracks);

/// One line per row of the report but for those of no row; Kind and Status as text.
void ReportToTable(const std::vector<ReportRow>& report, const SceneInfo& info, vtkTable* table);

} // namespace waft
