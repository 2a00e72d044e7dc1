// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/TreeData.h"

#include "Bridge/ArrayNames.h"
#include "Bridge/Arrays.h"
#include "Bridge/SceneData.h"

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
  std::vector<int> objects;
  std::vector<int> spans;
  std::vector<int> sides;
  std::vector<int> parents;
  std::vector<int> segments;
  std::vector<int> frames;
  std::vector<double> costs;
  for (const TreeBranch& branch : trees)
  {
    lines->InsertNextCell(static_cast<int>(branch.Points.size()));
    for (const Vec3& x : branch.Points)
    {
      lines->InsertCellPoint(static_cast<vtkIdType>(points.size()));
      points.push_back(x);
    }
    objects.push_back(branch.ObjectId);
    spans.push_back(branch.Span);
    sides.push_back(branch.Tree);
    parents.push_back(branch.Parent);
    segments.push_back(branch.Segment);
    frames.push_back(branch.Frame);
    costs.push_back(branch.Cost);
  }
  vtkNew<vtkPoints> vtkPointList;
  SetPoints(vtkPointList, points);
  data->SetPoints(vtkPointList);
  data->SetLines(lines);
  vtkFieldData* cells = data->GetCellData();
  AddInts(cells, names::ObjectId, objects);
  AddInts(cells, names::Span, spans);
  AddInts(cells, names::Tree, sides);
  AddInts(cells, names::Parent, parents);
  AddInts(cells, names::Segment, segments);
  AddInts(cells, names::Frame, frames);
  AddDoubles(cells, names::Cost, costs);
  SceneInfoToFieldData(info, data);
}

void TakesToTable(const std::vector<TakeScore>& takes, const SceneInfo& info, vtkTable* table)
{
  std::vector<int> numbers;
  std::vector<int> seeds;
  std::vector<int> met;
  std::vector<int> rows;
  std::vector<double> curvatures;
  std::vector<double> accelerations;
  std::vector<double> scores;
  for (const TakeScore& take : takes)
  {
    numbers.push_back(take.Take);
    seeds.push_back(static_cast<int>(take.Seed));
    met.push_back(take.NumberOfMet);
    rows.push_back(take.NumberOfRows);
    curvatures.push_back(take.Curvature);
    accelerations.push_back(take.Acceleration);
    scores.push_back(take.Score);
  }
  table->Initialize();
  vtkFieldData* columns = table->GetRowData();
  AddInts(columns, names::Take, numbers);
  AddInts(columns, names::Seed, seeds);
  AddInts(columns, names::Met, met);
  AddInts(columns, names::Rows, rows);
  AddDoubles(columns, names::CurvatureDistance, curvatures);
  AddDoubles(columns, names::AccelerationDistance, accelerations);
  AddDoubles(columns, names::Score, scores);
  SceneInfoToFieldData(info, table);
}

void FlightsToTable(const std::vector<FlightRow>& flights, const SceneInfo& info, vtkTable* table)
{
  std::vector<int> objects, rows, targets, frames, reached, branches;
  std::vector<double> factors, costs, seconds;
  for (const FlightRow& flight : flights)
  {
    objects.push_back(flight.ObjectId);
    rows.push_back(flight.Row);
    targets.push_back(flight.Target);
    frames.push_back(flight.Frame);
    reached.push_back(flight.IsReached ? 1 : 0);
    factors.push_back(flight.RetimingFactor);
    costs.push_back(flight.Cost);
    branches.push_back(flight.NumberOfBranches);
    seconds.push_back(flight.Seconds);
  }
  table->Initialize();
  vtkFieldData* columns = table->GetRowData();
  AddInts(columns, names::ObjectId, objects);
  AddInts(columns, names::Row, rows);
  AddInts(columns, names::Target, targets);
  AddInts(columns, names::Frame, frames);
  AddInts(columns, names::Reached, reached);
  AddDoubles(columns, names::RetimingFactor, factors);
  AddDoubles(columns, names::Cost, costs);
  AddInts(columns, names::Branches, branches);
  AddDoubles(columns, names::Seconds, seconds);
  SceneInfoToFieldData(info, table);
}

void ObjectRowsToTable(const std::vector<ObjectRow>& rows, const SceneInfo& info, vtkTable* table)
{
  std::vector<int> objects, counts, met, branches, planned;
  std::vector<double> costs, seconds;
  std::vector<std::string> statuses, messages;
  for (const ObjectRow& row : rows)
  {
    objects.push_back(row.ObjectId);
    counts.push_back(row.NumberOfRows);
    met.push_back(row.NumberOfMet);
    statuses.emplace_back(ToString(row.Status));
    costs.push_back(row.Cost);
    branches.push_back(row.NumberOfBranches);
    seconds.push_back(row.Seconds);
    planned.push_back(row.IsPlanned ? 1 : 0);
    messages.push_back(row.Message);
  }
  table->Initialize();
  vtkFieldData* columns = table->GetRowData();
  AddInts(columns, names::ObjectId, objects);
  AddInts(columns, names::Rows, counts);
  AddInts(columns, names::Met, met);
  AddStrings(columns, names::Status, statuses);
  AddDoubles(columns, names::Cost, costs);
  AddInts(columns, names::Branches, branches);
  AddDoubles(columns, names::Seconds, seconds);
  AddInts(columns, names::Planned, planned);
  AddStrings(columns, names::Message, messages);
  SceneInfoToFieldData(info, table);
}

Result GuidesFromPolyData(vtkPolyData* data, std::vector<Guide>& guides)
{
  guides.clear();
  if (data == nullptr)
  {
    return Result::Ok();
  }
  std::vector<int> ids;
  if (data->GetCellData()->HasArray(names::ObjectId))
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
      double x[3];
      data->GetPoint(points->GetId(i), x);
      guide.Points.emplace_back(x[0], x[1], x[2]);
    }
    guides.push_back(std::move(guide));
  }
  return Result::Ok();
}

} // namespace waft
