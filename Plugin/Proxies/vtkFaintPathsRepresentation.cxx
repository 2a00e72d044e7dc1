// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFaintPathsRepresentation.h"

#include "PartOfSurface.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkFaintPathsRepresentation);

namespace
{

constexpr vtkIdType MostLines = 150; // lines that are drawn
constexpr double FewLines = 12.0;    // lines from which on they are fainter than a single one
constexpr double PathStrength = 0.4;
constexpr double PathColor[3] = { 1.0, 0.97, 0.90 };

} // namespace

void vtkFaintPathsRepresentation::AddParts(vtkPolyData* block, double, Parts& parts)
{
  vtkCellArray* lines = block->GetLines();
  const vtkIdType step = (lines->GetNumberOfCells() - 1) / MostLines + 1;
  waft::PartOfSurface chosen(block);
  vtkIdType count = 0, place = 0, drawn = 0;
  const vtkIdType* points = nullptr;
  for (lines->InitTraversal(); lines->GetNextCell(count, points) != 0; ++place)
  {
    if (place % step == 0)
    {
      chosen.Add(count, points);
      ++drawn;
    }
  }
  if (drawn == 0)
  {
    return;
  }
  const vtkSmartPointer<vtkPolyData> paths = chosen.Take();
  paths->SetLines(paths->GetPolys());
  paths->SetPolys(vtkNew<vtkCellArray>());
  Part part;
  std::copy_n(PathColor, 3, part.Color);
  part.Opacity = PathStrength * std::min(1.0, std::sqrt(FewLines / static_cast<double>(drawn)));
  part.IsLit = false;
  part.Actor = this->ActorFor(parts, paths, nullptr);
  parts.push_back(std::move(part));
}

void vtkFaintPathsRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
