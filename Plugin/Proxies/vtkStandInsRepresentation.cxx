// SPDX-License-Identifier: BSD-3-Clause
#include "vtkStandInsRepresentation.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkStandInsRepresentation);

namespace
{

constexpr double UsualRadius = 0.05; // m, of what has none
constexpr double LeafColor[3] = { 0.52, 0.72, 0.26 };
constexpr int Stations = 9;                               // along a leaf
constexpr double Leaning[4] = { 0.906, 0.423, 0.0, 0.0 }; // of what starts as chance has it
constexpr double Width = 0.42, Bend = 0.22, Fold = 0.45;  // over half its length, of its width

/// A leaf about the origin, of half length 1: at each station the left rim, the vein and the right.
struct Leaf
{
  double Points[3 * Stations][3];

  Leaf()
  {
    for (int i = 0; i < Stations; ++i)
    {
      const double along = 2.0 * i / (Stations - 1) - 1.0;
      const double half =
        Width * std::pow(std::sin(0.5 * vtkMath::Pi() * (along + 1.0)), 0.8) * (1.0 - 0.25 * along);
      for (int side = -1; side <= 1; ++side)
      {
        double* point = this->Points[3 * i + side + 1];
        point[0] = along;
        point[1] = side * half;
        point[2] = Bend * (0.5 - along * along) + Fold * std::abs(side) * half;
      }
    }
  }
};

void AddLeaf(const Leaf& leaf, const double* center, double radius, const double* quaternion,
             vtkPoints* places, vtkCellArray* quads)
{
  double turn[3][3];
  vtkMath::QuaternionToMatrix3x3(quaternion, turn);
  const vtkIdType first = places->GetNumberOfPoints();
  for (const double* point : leaf.Points)
  {
    double turned[3];
    vtkMath::Multiply3x3(turn, point, turned);
    for (int axis = 0; axis < 3; ++axis)
    {
      turned[axis] = center[axis] + radius * turned[axis];
    }
    places->InsertNextPoint(turned);
  }
  for (int i = 0; i + 1 < Stations; ++i)
  {
    for (int side = 0; side < 2; ++side)
    {
      const vtkIdType at = first + 3 * i + side;
      const vtkIdType corners[4] = { at, at + 1, at + 4, at + 3 };
      quads->InsertNextCell(4, corners);
    }
  }
}

} // namespace

void vtkStandInsRepresentation::AddParts(vtkPolyData* block, double, Parts& parts)
{
  vtkDataArray* radii = block->GetPointData()->GetArray("ClearanceRadius");
  vtkDataArray* turns = block->GetPointData()->GetArray("Orientation");
  vtkDataArray* areGiven = block->GetPointData()->GetArray("OrientationGiven");
  const bool areTurned = turns != nullptr && turns->GetNumberOfComponents() == 4;
  const Leaf leaf;
  vtkNew<vtkPoints> places;
  vtkNew<vtkCellArray> quads;
  Part part;
  for (vtkIdType i = 0; i < block->GetNumberOfPoints(); ++i)
  {
    const double own = radii != nullptr ? radii->GetComponent(i, 0) : 0.0;
    const double radius = own > 0.0 ? own : UsualRadius;
    double quaternion[4];
    std::copy_n(Leaning, 4, quaternion);
    if (areTurned && (areGiven == nullptr || areGiven->GetComponent(i, 0) != 0.0))
    {
      turns->GetTuple(i, quaternion);
    }
    AddLeaf(leaf, block->GetPoint(i), radius, quaternion, places, quads);
    part.Reach = std::max(part.Reach, radius);
  }
  const auto leaves = vtkSmartPointer<vtkPolyData>::New();
  leaves->SetPoints(places);
  leaves->SetPolys(quads);
  std::copy_n(LeafColor, 3, part.Color);
  part.Actor = this->ActorFor(parts, leaves, nullptr);
  parts.push_back(std::move(part));
}

void vtkStandInsRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
