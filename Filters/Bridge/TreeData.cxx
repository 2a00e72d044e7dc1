// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/TreeData.h"

#include "Bridge/ArrayNames.h"
#include "Bridge/Arrays.h"
#include "Bridge/SceneData.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

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

} // namespace waft
