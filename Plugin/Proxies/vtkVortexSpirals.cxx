// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVortexSpirals.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTubeFilter.h>
#include <vtkVector.h>
#include <vtkVersionMacros.h>
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 4, 0)
#include <vtkVectorOperators.h> // of vtkVector.h itself since then
#endif

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkVortexSpirals);

namespace
{

constexpr double LeastCore = 0.04; // of a spiral, over the length of its axis
constexpr double MostCore = 0.2;   // likewise
constexpr double Pitch = 1.6;      // of a turn, over the radius
constexpr int FewestTurns = 4, MostTurns = 12;
constexpr double Gap = 0.12;   // of a turn, before the next begins
constexpr int TurnPoints = 24; // of a turn
constexpr int TubeSides = 8;
constexpr double EndRadius = 0.014, BeginRadius = 0.002,
                 AxisRadius = 0.002; // radii, over the length
constexpr const char* Thickness = "Thickness";

struct Spirals
{
  vtkCellData* From;
  vtkNew<vtkPoints> Places;
  vtkNew<vtkCellArray> Lines;
  vtkNew<vtkFloatArray> Radii;
  vtkNew<vtkPolyData> Made;

  explicit Spirals(vtkCellData* from) : From(from)
  {
    this->Radii->SetName(Thickness);
    this->Made->GetCellData()->CopyAllocate(from);
  }

  void Begin(int points, vtkIdType vortex)
  {
    this->Made->GetCellData()->CopyData(this->From, vortex, this->Lines->InsertNextCell(points));
  }

  void Add(const vtkVector3d& place, double radius)
  {
    this->Lines->InsertCellPoint(this->Places->InsertNextPoint(place.GetData()));
    this->Radii->InsertNextValue(static_cast<float>(radius));
  }

  void AddVortex(vtkIdType vortex, const vtkVector3d& begin, const vtkVector3d& end)
  {
    const vtkVector3d way = end - begin;
    const double length = way.Norm();
    if (!(length > 0.0))
    {
      return;
    }
    const auto value = [&](const char* name)
    {
      vtkDataArray* values = this->From->GetArray(name);
      return values != nullptr ? values->GetComponent(vortex, 0) : 0.0;
    };
    const double radius = std::clamp(value("CoreRadius"), LeastCore * length, MostCore * length);
    const double sense = value("Strength") < 0.0 ? -1.0 : 1.0;
    vtkVector3d side, other;
    vtkMath::Perpendiculars(way.GetData(), side.GetData(), other.GetData(), 0.0);
    if (side.Cross(other).Dot(way) < 0.0)
    {
      other = other * -1.0;
    }
    this->Begin(2, vortex);
    this->Add(begin, AxisRadius * length);
    this->Add(end, AxisRadius * length);
    const int turns =
      std::clamp(static_cast<int>(length / (Pitch * radius)), FewestTurns, MostTurns);
    for (int turn = 0; turn < turns; ++turn)
    {
      this->Begin(TurnPoints, vortex);
      for (int i = 0; i < TurnPoints; ++i)
      {
        const double share = static_cast<double>(i) / (TurnPoints - 1);
        const double at = turn + (1.0 - Gap) * share;
        const double angle = sense * 2.0 * vtkMath::Pi() * at;
        this->Add(begin + way * (at / turns) + side * (radius * std::cos(angle)) +
                    other * (radius * std::sin(angle)),
                  length * (BeginRadius + (EndRadius - BeginRadius) * share));
      }
    }
  }

  vtkPolyData* Take()
  {
    this->Made->SetPoints(this->Places);
    this->Made->SetLines(this->Lines);
    this->Made->GetPointData()->SetScalars(this->Radii);
    return this->Made;
  }
};

} // namespace

int vtkVortexSpirals::FillInputPortInformation(int vtkNotUsed(port), vtkInformation* information)
{
  information->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  return 1;
}

int vtkVortexSpirals::RequestData(vtkInformation* vtkNotUsed(request), vtkInformationVector** input,
                                  vtkInformationVector* output)
{
  // A view that has no data yet, or none on this process, gives something else.
  vtkPolyData* vortices = vtkPolyData::GetData(input[0], 0);
  if (vortices == nullptr || vortices->GetNumberOfLines() == 0)
  {
    return 1;
  }
  Spirals spirals(vortices->GetCellData());
  vtkIdType count = 0, line = vortices->GetNumberOfVerts(); // cells are numbered vertices first
  const vtkIdType* points = nullptr;
  vtkCellArray* lines = vortices->GetLines();
  for (lines->InitTraversal(); lines->GetNextCell(count, points) != 0; ++line)
  {
    if (count > 1)
    {
      vtkVector3d begin, end;
      vortices->GetPoint(points[0], begin.GetData());
      vortices->GetPoint(points[count - 1], end.GetData());
      spirals.AddVortex(line, begin, end);
    }
  }
  vtkNew<vtkTubeFilter> tubes;
  tubes->SetInputData(spirals.Take());
  tubes->SetNumberOfSides(TubeSides);
  tubes->SetVaryRadiusToVaryRadiusByAbsoluteScalar();
  tubes->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, Thickness);
  tubes->CappingOn();
  tubes->Update();
  vtkPolyData* made = vtkPolyData::GetData(output);
  made->ShallowCopy(tubes->GetOutput());
  made->GetPointData()->RemoveArray(Thickness);
  return 1;
}

void vtkVortexSpirals::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
