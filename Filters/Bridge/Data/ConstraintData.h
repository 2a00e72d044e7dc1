// SPDX-License-Identifier: BSD-3-Clause
// Constraints, and what became of them.
#pragma once

#include "Base/Motion.h"
#include "Base/Result.h"
#include "Base/Types.h"
#include "Constraints/Constraint.h"

#include <map>
#include <string>
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

/// What a report says of rows becomes their Status, which was the planner's, and says when rests
/// began, where that is known.
template <class Line>
void TakeStatuses(const std::vector<Line>& report, std::vector<Constraint>& constraints)
{
  std::map<std::pair<int, int>, const ReportRow*> lines;
  for (const ReportRow& line : report)
  {
    lines[{ line.Row, line.Target }] = &line;
  }
  for (Constraint& row : constraints)
  {
    const auto found = lines.find({ row.Row, row.Target });
    if (found == lines.end())
    {
      continue;
    }
    const ReportRow& line = *found->second;
    row.Status = line.Status;
    if (IsRest(row.Kind) && line.Settled >= 0)
    {
      row.TouchDown = line.TouchDown;
      row.Settled = line.Settled;
    }
  }
}

/// Point data `Arrival` of objects, by their `ObjectId`: the frame at which each is where the first
/// of its positions and rests that can be met asks it to be; -1: no row asks, or the air has yet to
/// choose. `Leave`, of its track: the frame from which it is gone; -1: it stays.
void AddArrivals(const std::vector<Constraint>& constraints, const std::vector<Track>& tracks,
                 vtkPolyData* objects);

/// Cell data of tracks or poses: `TouchDown` and `Settled`, the frame at which a body that lies to
/// the end, asked for or not, comes to its surface, and from which it is still; -1: it does not
/// lie. `Arrival` as above.
void AddRowTimes(const std::vector<Constraint>& constraints, vtkPolyData* tracks);

/// Field data `LandingHeight`, a number a row: of a rest that is met the height [m] of the surface
/// that its body comes to lie on, as its track says; NaN of others. objects: those of the rows.
void AddLandings(const std::vector<Constraint>& constraints,
                 const std::vector<MotionObject>& objects, const std::vector<Track>& tracks,
                 vtkPolyData* rows);

/// By track, at which frame its body is still, -1 where it does not lie to the end.
std::vector<int> SettledFrames(const std::vector<Constraint>& constraints,
                               const std::vector<Track>& tracks);

/// One line per row of the report but for those of no row; Kind and Status as text.
void ReportToTable(const std::vector<ReportRow>& report, const SceneInfo& info, vtkTable* table);
/// The lines of such a table, whose columns may all be texts, as a file has them. owner: "planned
/// report", for messages. Fails on an absent column and on what is no number, kind or status.
Result ReportFromTable(vtkTable* table, const std::string& owner, std::vector<ReportRow>& report);

} // namespace waft
