// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSegmentFanRepresentation.h"

#include "PartOfSurface.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <map>

vtkStandardNewMacro(vtkSegmentFanRepresentation);

namespace
{

constexpr vtkIdType MostSegments = 1500; // that are drawn
constexpr double FewSegments = 40.0;     // from which on they are fainter than a single one
constexpr double GroupColors[][3] = { { 1.0, 0.80, 0.36 },
                                      { 0.62, 0.88, 1.0 },
                                      { 0.98, 0.55, 0.42 } };

} // namespace

void vtkSegmentFanRepresentation::AddParts(vtkPolyData* block, double, Parts& parts)
{
  vtkDataArray* groups = block->GetCellData()->GetArray("Group");
  vtkCellArray* lines = block->GetLines();
  if (groups == nullptr || lines->GetNumberOfCells() == 0)
  {
    return;
  }
  const vtkIdType step = (lines->GetNumberOfCells() - 1) / MostSegments + 1;
  std::map<int, waft::PartOfSurface> fans;
  vtkIdType count = 0, line = 0;
  const vtkIdType* points = nullptr;
  for (lines->InitTraversal(); lines->GetNextCell(count, points) != 0; ++line)
  {
    if (line % step == 0 && count > 1)
    {
      const auto group = static_cast<int>(groups->GetComponent(line, 0));
      fans.try_emplace(group, block).first->second.Add(count, points);
    }
  }
  const double drawn = static_cast<double>(line) / static_cast<double>(step);
  for (const auto& [group, fan] : fans)
  {
    const vtkSmartPointer<vtkPolyData> made = fan.Take();
    made->SetLines(made->GetPolys());
    made->SetPolys(vtkNew<vtkCellArray>());
    Part part;
    std::copy_n(GroupColors[static_cast<unsigned int>(group) % std::size(GroupColors)], 3,
                part.Color);
    part.Opacity = std::clamp(std::sqrt(FewSegments / std::max(drawn, 1.0)), 0.25, 0.95);
    part.IsLit = false;
    part.IsVeil = true;
    part.Actor = this->ActorFor(parts, made, nullptr);
    parts.push_back(std::move(part));
  }
}

void vtkSegmentFanRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
