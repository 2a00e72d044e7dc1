// SPDX-License-Identifier: BSD-3-Clause
#include "vtkStreamlineTubes.h"

#include <vtkCellArray.h>
#include <vtkDataArray.h>
#include <vtkDataSet.h>
#include <vtkFloatArray.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStreamTracer.h>
#include <vtkTubeFilter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

vtkStandardNewMacro(vtkStreamlineTubes);

namespace
{

constexpr double PLASTIC = 1.2207440846057596; // x^4 = x + 1
constexpr double STEP = 0.5;                   // of a cell
constexpr double THINNEST = 0.25;              // of the thickest
constexpr int SIDES = 6;
constexpr const char* ALONG = "Along";

std::string VectorsOf(vtkDataSet* field)
{
  for (const char* name : { "Velocity", "Wind" })
  {
    vtkDataArray* values = field->GetPointData()->GetArray(name);
    if (values != nullptr && values->GetNumberOfComponents() == 3)
    {
      return name;
    }
  }
  vtkDataArray* active = field->GetPointData()->GetVectors();
  return active != nullptr && active->GetName() != nullptr ? active->GetName() : "";
}

void SpreadPlaces(vtkDataSet* field, int count, vtkPolyData* places)
{
  const double* bounds = field->GetBounds();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int i = 0; i < count; ++i)
  {
    std::array<double, 3> place{};
    double step = 1.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      step /= PLASTIC;
      const double share = std::fmod(0.5 + (i + 1) * step, 1.0);
      place[axis] = bounds[2 * axis] + share * (bounds[2 * axis + 1] - bounds[2 * axis]);
    }
    points->InsertNextPoint(place.data());
  }
  places->SetPoints(points);
}

// How far along its line each point is, from THINNEST to 1.
void MeasureAlong(vtkPolyData* lines)
{
  vtkNew<vtkFloatArray> along;
  along->SetName(ALONG);
  along->SetNumberOfTuples(lines->GetNumberOfPoints());
  along->Fill(1.0);
  vtkIdType count = 0;
  const vtkIdType* ids = nullptr;
  vtkCellArray* cells = lines->GetLines();
  for (cells->InitTraversal(); cells->GetNextCell(count, ids) != 0;)
  {
    for (vtkIdType i = 0; i < count; ++i)
    {
      along->SetValue(ids[i], THINNEST + (1.0 - THINNEST) * i / std::max<vtkIdType>(count - 1, 1));
    }
  }
  lines->GetPointData()->AddArray(along);
}

} // namespace

int vtkStreamlineTubes::FillInputPortInformation(int vtkNotUsed(port), vtkInformation* information)
{
  information->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  return 1;
}

int vtkStreamlineTubes::RequestData(vtkInformation* vtkNotUsed(request),
                                    vtkInformationVector** input, vtkInformationVector* output)
{
  // A view that has no data yet, or none on this process, gives something else.
  vtkDataSet* field = vtkDataSet::GetData(input[0], 0);
  const bool isDrawn = this->LineLength > 0.0 && this->TubeRadius > 0.0; // numbers, too
  if (isDrawn && field != nullptr && field->GetNumberOfPoints() > 0 && !VectorsOf(field).empty())
  {
    this->Trace(field, vtkPolyData::GetData(output));
  }
  return 1;
}

void vtkStreamlineTubes::Trace(vtkDataSet* field, vtkPolyData* lines) const
{
  const std::string vectors = VectorsOf(field);
  const double diagonal = field->GetLength();
  vtkNew<vtkPolyData> places;
  SpreadPlaces(field, this->NumberOfLines, places);

  vtkNew<vtkStreamTracer> tracer;
  tracer->SetInputData(field);
  tracer->SetSourceData(places);
  tracer->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vectors.c_str());
  tracer->SetIntegratorTypeToRungeKutta4();
  tracer->SetIntegrationDirectionToForward();
  tracer->SetIntegrationStepUnit(vtkStreamTracer::CELL_LENGTH_UNIT);
  tracer->SetInitialIntegrationStep(STEP);
  tracer->SetMaximumPropagation(this->LineLength * diagonal);
  tracer->SetComputeVorticity(false);
  tracer->Update();

  vtkNew<vtkPolyData> traced;
  traced->ShallowCopy(tracer->GetOutput());
  MeasureAlong(traced);
  vtkNew<vtkTubeFilter> tubes;
  tubes->SetInputData(traced);
  tubes->SetNumberOfSides(SIDES);
  tubes->SetRadius(THINNEST * this->TubeRadius * diagonal);
  tubes->SetRadiusFactor(1.0 / THINNEST);
  tubes->SetVaryRadiusToVaryRadiusByScalar();
  tubes->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, ALONG);
  tubes->CappingOn();
  tubes->Update();
  lines->ShallowCopy(tubes->GetOutput());
  lines->GetPointData()->RemoveArray(ALONG);
}

void vtkStreamlineTubes::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfLines: " << this->NumberOfLines << "\n";
  os << indent << "LineLength: " << this->LineLength << "\n";
  os << indent << "TubeRadius: " << this->TubeRadius << "\n";
}
