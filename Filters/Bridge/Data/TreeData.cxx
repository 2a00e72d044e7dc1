// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/TreeData.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Columns.h"
#include "Bridge/Data/SceneData.h"

#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTable.h>

namespace waft
{

void TreesToPolyData(const std::vector<TreeBranch>& trees, const SceneInfo& info, vtkPolyData* data)
{
  data->Initialize();
  std::vector<Vec3> points;
  vtkNew<vtkCellArray> lines;
  for (const TreeBranch& branch : trees)
  {
    lines->InsertNextCell(static_cast<int>(branch.Points.size()));
    for (const Vec3& x : branch.Points)
    {
      lines->InsertCellPoint(static_cast<vtkIdType>(points.size()));
      points.push_back(x);
    }
  }
  vtkNew<vtkPoints> vtkPointList;
  SetPoints(vtkPointList, points);
  data->SetPoints(vtkPointList);
  data->SetLines(lines);
  vtkFieldData* cells = data->GetCellData();
  AddColumn(cells, names::ObjectId, trees, &TreeBranch::ObjectId);
  AddColumn(cells, names::Span, trees, &TreeBranch::Span);
  AddColumn(cells, names::Tree, trees, &TreeBranch::Tree);
  AddColumn(cells, names::Parent, trees, &TreeBranch::Parent);
  AddColumn(cells, names::Segment, trees, &TreeBranch::Segment);
  AddColumn(cells, names::Frame, trees, &TreeBranch::Frame);
  AddColumn(cells, names::Cost, trees, &TreeBranch::Cost);
  SceneInfoToFieldData(info, data);
}

void TakesToTable(const std::vector<TakeScore>& takes, const SceneInfo& info, vtkTable* table)
{
  table->Initialize();
  vtkFieldData* columns = table->GetRowData();
  AddColumn(columns, names::Take, takes, &TakeScore::Take);
  AddColumn(columns, names::Seed, takes,
            [](const TakeScore& take) { return static_cast<int>(take.Seed); });
  AddColumn(columns, names::Met, takes, &TakeScore::NumberOfMet);
  AddColumn(columns, names::Rows, takes, &TakeScore::NumberOfRows);
  AddColumn(columns, names::CurvatureDistance, takes, &TakeScore::Curvature);
  AddColumn(columns, names::AccelerationDistance, takes, &TakeScore::Acceleration);
  AddColumn(columns, names::Score, takes, &TakeScore::Score);
  SceneInfoToFieldData(info, table);
}

void FlightsToTable(const std::vector<FlightRow>& flights, const SceneInfo& info, vtkTable* table)
{
  table->Initialize();
  vtkFieldData* columns = table->GetRowData();
  AddColumn(columns, names::ObjectId, flights, &FlightRow::ObjectId);
  AddColumn(columns, names::Row, flights, &FlightRow::Row);
  AddColumn(columns, names::Target, flights, &FlightRow::Target);
  AddColumn(columns, names::Frame, flights, &FlightRow::Frame);
  AddColumn(columns, names::Reached, flights,
            [](const FlightRow& flight) { return flight.IsReached ? 1 : 0; });
  AddColumn(columns, names::RetimingFactor, flights, &FlightRow::RetimingFactor);
  AddColumn(columns, names::Cost, flights, &FlightRow::Cost);
  AddColumn(columns, names::Branches, flights, &FlightRow::NumberOfBranches);
  AddColumn(columns, names::Seconds, flights, &FlightRow::Seconds);
  SceneInfoToFieldData(info, table);
}

void ObjectRowsToTable(const std::vector<ObjectRow>& rows, const SceneInfo& info, vtkTable* table)
{
  table->Initialize();
  vtkFieldData* columns = table->GetRowData();
  AddColumn(columns, names::ObjectId, rows, &ObjectRow::ObjectId);
  AddColumn(columns, names::Rows, rows, &ObjectRow::NumberOfRows);
  AddColumn(columns, names::Met, rows, &ObjectRow::NumberOfMet);
  AddColumn(columns, names::Status, rows,
            [](const ObjectRow& row) { return std::string(ToString(row.Status)); });
  AddColumn(columns, names::Cost, rows, &ObjectRow::Cost);
  AddColumn(columns, names::Branches, rows, &ObjectRow::NumberOfBranches);
  AddColumn(columns, names::Seconds, rows, &ObjectRow::Seconds);
  AddColumn(columns, names::Planned, rows,
            [](const ObjectRow& row) { return row.IsPlanned ? 1 : 0; });
  AddColumn(columns, names::Message, rows, &ObjectRow::Message);
  SceneInfoToFieldData(info, table);
}

Result GuidesFromPolyData(vtkPolyData* data, std::vector<Guide>& guides)
{
  guides.clear();
  if (data == nullptr)
  {
    return Result::Ok();
  }
  std::vector<Vec3> positions;
  WAFT_RETURN_IF_FAILED(ReadPoints(data->GetPoints(), "Guides", positions));
  WAFT_RETURN_IF_FAILED(CheckCells(data, "Guides"));
  std::vector<int> ids;
  if (data->GetCellData()->GetAbstractArray(names::ObjectId))
  {
    WAFT_RETURN_IF_FAILED(
      ReadInts({ data->GetCellData(), "Guides: cell data array", data->GetNumberOfCells() },
               names::ObjectId, ids));
  }
  const vtkIdType before = data->GetNumberOfVerts();
  for (vtkIdType k = 0; k < data->GetNumberOfLines(); ++k)
  {
    Guide guide;
    guide.ObjectId = ids.empty() ? static_cast<int>(k) : ids[static_cast<std::size_t>(before + k)];
    vtkIdList* points = data->GetCell(before + k)->GetPointIds();
    for (vtkIdType i = 0; i < points->GetNumberOfIds(); ++i)
    {
      guide.Points.push_back(positions[static_cast<std::size_t>(points->GetId(i))]);
    }
    guides.push_back(std::move(guide));
  }
  return Result::Ok();
}

} // namespace waft
