// SPDX-License-Identifier: BSD-3-Clause
#include "vtkObstacleSource.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Scene/ObstacleOptions.h"

#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <vector>

vtkStandardNewMacro(vtkObstacleSource);

vtkObstacleSource::vtkObstacleSource()
{
  waft::TakeDefaults<waft::ObstacleSourceOptions>(*this);
  this->SetNumberOfInputPorts(0);
}

double vtkObstacleSource::InRange(const char* property, double value)
{
  return waft::InRange<waft::ObstacleSourceOptions>(property, value);
}

vtkTypeBool vtkObstacleSource::ProcessRequest(vtkInformation* request,
                                              vtkInformationVector** inputs,
                                              vtkInformationVector* outputs)
{
  return waft::GuardedRequest(
    this, request, outputs, waft::RangesOf<waft::ObstacleSourceOptions>(*this),
    [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

int vtkObstacleSource::RequestInformation(vtkInformation*, vtkInformationVector**,
                                          vtkInformationVector* outputs)
{
  waft::SetTimeSteps(waft::OptionsOf<waft::SceneFrame>(*this).Info().Time, outputs);
  return 1;
}

int vtkObstacleSource::RequestData(vtkInformation*, vtkInformationVector**,
                                   vtkInformationVector* outputs)
{
  const auto options = waft::OptionsOf<waft::ObstacleSourceOptions>(*this);
  std::vector<waft::ObstacleMesh> obstacles;
  if (const waft::Result made = options.Make(obstacles); !made)
  {
    return waft::Fail(this, outputs, made.Message());
  }
  const waft::SceneInfo info = options.Info();
  vtkPolyData* data = vtkPolyData::GetData(outputs);
  waft::ObstaclesToPolyData(obstacles, 0.0, info, data);
  data->GetPointData()->RemoveArray(waft::names::ObstacleId);
  waft::AuthoredToFieldData(options.Authored(), data);
  waft::RequestedTime(outputs, 0, info.Time);
  return 1;
}

void vtkObstacleSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::ObstacleSourceOptions>(os, indent, *this);
}
