// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFaintPathsRepresentation.h"

#include "PartOfSurface.h"

#include <vtkActor.h>
#include <vtkBoundingBox.h>
#include <vtkCellArray.h>
#include <vtkLine.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

vtkStandardNewMacro(vtkFaintPathsRepresentation);

namespace
{

constexpr vtkIdType MostLines = 150; // lines that are drawn
constexpr double FewLines = 12.0;    // lines from which on they are fainter than a single one
constexpr double PathStrength = 0.4;
constexpr double PathColor[3] = { 1.0, 0.97, 0.90 };
// How far a path may be drawn beside itself, of the size of all: less than is seen of a pixel.
constexpr double Aside = 5e-4;

/// Those of a path's points that tell its form: the longest chords that no point between lies
/// aside of.
std::vector<vtkIdType> FormOf(vtkPoints* places, vtkIdType count, const vtkIdType* points,
                              double aside)
{
  using Place = std::array<double, 3>;
  std::vector<Place> path(static_cast<std::size_t>(count));
  for (vtkIdType i = 0; i < count; ++i)
  {
    places->GetPoint(points[i], path[static_cast<std::size_t>(i)].data());
  }
  const auto isChord = [&](vtkIdType begin, vtkIdType end)
  {
    for (vtkIdType i = begin + 1; i < end; ++i)
    {
      if (vtkLine::DistanceToLine(path[i].data(), path[begin].data(), path[end].data()) >
          aside * aside)
      {
        return false;
      }
    }
    return true;
  };
  std::vector<vtkIdType> form;
  vtkIdType begin = 0;
  for (vtkIdType end = 1; end < count; ++end)
  {
    if (!isChord(begin, end))
    {
      form.push_back(points[begin]);
      begin = end - 1;
    }
  }
  form.push_back(points[begin]);
  form.push_back(points[count - 1]);
  return form;
}

} // namespace

void vtkFaintPathsRepresentation::AddParts(vtkPolyData* block, double, Parts& parts)
{
  vtkCellArray* lines = block->GetLines();
  const vtkIdType step = (lines->GetNumberOfCells() - 1) / MostLines + 1;
  waft::PartOfSurface chosen(block);
  const double aside = Aside * vtkBoundingBox(block->GetBounds()).GetDiagonalLength();
  vtkIdType count = 0, place = 0, drawn = 0;
  const vtkIdType* points = nullptr;
  for (lines->InitTraversal(); lines->GetNextCell(count, points) != 0; ++place)
  {
    if (place % step == 0 && count > 1)
    {
      const std::vector<vtkIdType> form = FormOf(block->GetPoints(), count, points, aside);
      chosen.Add(static_cast<vtkIdType>(form.size()), form.data());
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
  part.IsVeil = true;
  part.Actor = this->ActorFor(parts, paths, nullptr);
  parts.push_back(std::move(part));
}

void vtkFaintPathsRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
