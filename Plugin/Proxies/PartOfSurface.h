// SPDX-License-Identifier: BSD-3-Clause
// What of a surface is drawn by itself.
#pragma once

#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <map>
#include <vector>

class vtkActor;
class vtkDataArray;
class vtkFloatArray;
class vtkPolyData;

namespace waft
{

/// Some polygons of a surface with their points, in the order in which they come, and the normals
/// and texture coordinates of these.
class PartOfSurface
{
public:
  explicit PartOfSurface(vtkPolyData* whole);
  void Add(vtkIdType count, const vtkIdType* corners);
  vtkSmartPointer<vtkPolyData> Take() const;

private:
  vtkSmartPointer<vtkFloatArray> Picked(vtkDataArray* array) const;

  vtkPolyData* Whole;
  vtkNew<vtkCellArray> Cells;
  std::vector<vtkIdType> Points; // of the whole
  std::vector<vtkIdType> Place;  // in the part, by point of the whole
};

/// {number: part} of the polygons by the number that a point array gives their first corners; all
/// are of 0 without that array, and where it is less.
std::map<vtkIdType, vtkSmartPointer<vtkPolyData>> PartsBy(const char* array, vtkPolyData* surface);

/// Lets an actor take the colours of its points as they are.
void TakeColorsOfPoints(vtkActor* actor);

} // namespace waft
