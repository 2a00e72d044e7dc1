// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMotionReport.h"

#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Files/FlightFiles.h"
#include "Chain/JoinedReport.h"

#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkTable.h>

vtkStandardNewMacro(vtkMotionReport);

namespace
{

struct Reports
{
  waft::SceneInfo Scene;
  std::vector<waft::ReportRow> Moved, Planned, Turned;
  std::vector<waft::Constraint> Rows;
};

waft::Result Read(vtkTable* moved, vtkTable* planned, vtkTable* turned, vtkPolyData* constraints,
                  Reports& read)
{
  WAFT_RETURN_IF_FAILED(waft::ReportFromTable(moved, "report of the moved objects", read.Moved));
  WAFT_RETURN_IF_FAILED(waft::ReportFromTable(planned, "report of the plan", read.Planned));
  WAFT_RETURN_IF_FAILED(waft::ReportFromTable(turned, "report of the turned bodies", read.Turned));
  if (constraints->GetNumberOfPoints() > 0)
  {
    WAFT_RETURN_IF_FAILED(waft::SceneInfoFromFieldData(constraints, read.Scene));
    WAFT_RETURN_IF_FAILED(waft::ConstraintsFromPolyData(constraints, read.Scene.Time, read.Rows));
  }
  waft::TakeStatuses(read.Turned, read.Rows); // when rests begin by their poses
  return waft::Result::Ok();
}

} // namespace

std::string vtkMotionReport::Join(vtkTable* moved, vtkTable* planned, vtkTable* turned,
                                  vtkPolyData* constraints, vtkTable* joined)
{
  if (moved == nullptr || planned == nullptr || turned == nullptr || constraints == nullptr ||
      joined == nullptr)
  {
    return "expected three reports, Constraints and a table, found none of one of them";
  }
  Reports read;
  const waft::Result result = Read(moved, planned, turned, constraints, read);
  if (!result)
  {
    return result.Message();
  }
  waft::JoinedReportToTable(waft::JoinReports(read.Moved, read.Planned, read.Turned, read.Rows),
                            read.Scene, joined);
  return {};
}
