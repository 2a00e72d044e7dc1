// SPDX-License-Identifier: BSD-3-Clause
#include "vtkConstraintSource.h"

#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Scene/ConstraintOptions.h"

#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

#include <algorithm>

vtkStandardNewMacro(vtkConstraintSource);

vtkConstraintSource::vtkConstraintSource()
{
  waft::TakeDefaults<waft::ConstraintOptions>(*this);
  this->SetNumberOfInputPorts(0);
}

double vtkConstraintSource::InRange(const char* property, double value)
{
  return waft::InRange<waft::ConstraintOptions>(property, value);
}

void vtkConstraintSource::SetNumberOfWaypoints(int count)
{
  if (count > waft::limits::Frames.High)
  {
    vtkErrorMacro("NumberOfWaypoints: expected at most "
                  << static_cast<int>(waft::limits::Frames.High) << ", found " << count);
    return;
  }
  const auto size = static_cast<std::size_t>(std::max(0, count));
  if (size != this->Waypoints.size())
  {
    this->Waypoints.resize(size, { 0.0, 0.0, 0.0 });
    this->Modified();
  }
}

void vtkConstraintSource::SetWaypoint(int index, double x, double y, double z)
{
  const std::array<double, 3> point{ x, y, z };
  if (index < 0)
  {
    return;
  }
  if (index >= this->GetNumberOfWaypoints())
  {
    this->SetNumberOfWaypoints(std::min(index, VTK_INT_MAX - 1) + 1);
  }
  if (index >= this->GetNumberOfWaypoints())
  {
    return; // it was refused
  }
  if (this->Waypoints[static_cast<std::size_t>(index)] != point)
  {
    this->Waypoints[static_cast<std::size_t>(index)] = point;
    this->Modified();
  }
}

void vtkConstraintSource::GetWaypoint(int index, double point[3]) const
{
  const bool isThere = index >= 0 && index < this->GetNumberOfWaypoints();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    point[axis] = isThere ? this->Waypoints[static_cast<std::size_t>(index)][axis] : 0.0;
  }
}

vtkTypeBool vtkConstraintSource::ProcessRequest(vtkInformation* request,
                                                vtkInformationVector** inputs,
                                                vtkInformationVector* outputs)
{
  return waft::GuardedRequest(
    this, request, outputs, waft::RangesOf<waft::ConstraintOptions>(*this),
    [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

int vtkConstraintSource::RequestInformation(vtkInformation*, vtkInformationVector**,
                                            vtkInformationVector* outputs)
{
  waft::SetTimeSteps(waft::OptionsOf<waft::SceneFrame>(*this).Info().Time, outputs);
  return 1;
}

int vtkConstraintSource::RequestData(vtkInformation*, vtkInformationVector**,
                                     vtkInformationVector* outputs)
{
  const auto options = waft::OptionsOf<waft::ConstraintOptions>(*this);
  std::vector<waft::Constraint> rows;
  if (const waft::Result made = options.MakeRows(rows); !made)
  {
    return waft::Fail(this, outputs, made.Message());
  }
  const waft::SceneInfo info = options.Info();
  waft::ConstraintsToPolyData(rows, info, vtkPolyData::GetData(outputs));
  waft::RequestedTime(outputs, 0, info.Time);
  return 1;
}

void vtkConstraintSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::ConstraintOptions>(os, indent, *this);
}
