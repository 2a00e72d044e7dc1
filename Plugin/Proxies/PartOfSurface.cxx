// SPDX-License-Identifier: BSD-3-Clause
#include "PartOfSurface.h"

#include <vtkActor.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkMapper.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>

namespace waft
{

PartOfSurface::PartOfSurface(vtkPolyData* whole) :
  Whole(whole), Place(static_cast<std::size_t>(whole->GetNumberOfPoints()), -1)
{
}

void PartOfSurface::Add(vtkIdType count, const vtkIdType* corners)
{
  this->Cells->InsertNextCell(static_cast<int>(count));
  for (vtkIdType i = 0; i < count; ++i)
  {
    vtkIdType& place = this->Place[static_cast<std::size_t>(corners[i])];
    if (place < 0)
    {
      place = static_cast<vtkIdType>(this->Points.size());
      this->Points.push_back(corners[i]);
    }
    this->Cells->InsertCellPoint(place);
  }
}

vtkSmartPointer<vtkPolyData> PartOfSurface::Take() const
{
  const auto part = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetData(this->Picked(this->Whole->GetPoints()->GetData()));
  part->SetPoints(points);
  part->SetPolys(this->Cells);
  vtkPointData* data = this->Whole->GetPointData();
  if (data->GetNormals() != nullptr)
  {
    part->GetPointData()->SetNormals(this->Picked(data->GetNormals()));
  }
  if (data->GetTCoords() != nullptr)
  {
    part->GetPointData()->SetTCoords(this->Picked(data->GetTCoords()));
  }
  return part;
}

vtkSmartPointer<vtkFloatArray> PartOfSurface::Picked(vtkDataArray* array) const
{
  const auto picked = vtkSmartPointer<vtkFloatArray>::New();
  const int count = array->GetNumberOfComponents();
  picked->SetName(array->GetName());
  picked->SetNumberOfComponents(count);
  picked->SetNumberOfTuples(static_cast<vtkIdType>(this->Points.size()));
  float* value = picked->GetPointer(0);
  std::vector<double> tuple(static_cast<std::size_t>(count));
  for (const vtkIdType point : this->Points)
  {
    array->GetTuple(point, tuple.data());
    value = std::transform(tuple.begin(), tuple.end(), value,
                           [](double number) { return static_cast<float>(number); });
  }
  return picked;
}

std::map<vtkIdType, vtkSmartPointer<vtkPolyData>> PartsBy(const char* array, vtkPolyData* surface)
{
  vtkDataArray* numbers = surface->GetPointData()->GetArray(array);
  std::map<vtkIdType, PartOfSurface> parts;
  vtkIdType count = 0;
  const vtkIdType* corners = nullptr;
  vtkCellArray* polygons = surface->GetPolys();
  for (polygons->InitTraversal(); polygons->GetNextCell(count, corners) != 0;)
  {
    const auto number = numbers != nullptr && count > 0
                          ? static_cast<vtkIdType>(numbers->GetComponent(corners[0], 0))
                          : 0;
    parts.try_emplace(std::max<vtkIdType>(number, 0), surface).first->second.Add(count, corners);
  }
  std::map<vtkIdType, vtkSmartPointer<vtkPolyData>> taken;
  for (const auto& [number, part] : parts)
  {
    taken[number] = part.Take();
  }
  return taken;
}

void TakeColorsOfPoints(vtkActor* actor)
{
  actor->GetMapper()->ScalarVisibilityOn();
  actor->GetMapper()->SetColorModeToDirectScalars();
}

} // namespace waft
