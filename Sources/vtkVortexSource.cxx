// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVortexSource.h"

#include "Bridge/Data/VortexData.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Scene/ForceOptions.h"

#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkVortexSource);

vtkVortexSource::vtkVortexSource()
{
  waft::TakeDefaults<waft::VortexSourceOptions>(*this);
  this->SetNumberOfInputPorts(0);
}

double vtkVortexSource::InRange(const char* property, double value)
{
  return waft::InRange<waft::VortexSourceOptions>(property, value);
}

vtkTypeBool vtkVortexSource::ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                                            vtkInformationVector* outputs)
{
  return waft::GuardedRequest(
    this, request, outputs, waft::RangesOf<waft::VortexSourceOptions>(*this),
    [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

int vtkVortexSource::RequestInformation(vtkInformation*, vtkInformationVector**,
                                        vtkInformationVector* outputs)
{
  waft::SetTimeSteps(waft::OptionsOf<waft::SceneFrame>(*this).Info().Time, outputs);
  return 1;
}

int vtkVortexSource::RequestData(vtkInformation*, vtkInformationVector**,
                                 vtkInformationVector* outputs)
{
  const auto options = waft::OptionsOf<waft::VortexSourceOptions>(*this);
  waft::Vortex vortex;
  if (const waft::Result made = options.Make(vortex); !made)
  {
    return waft::Fail(this, outputs, made.Message());
  }
  const waft::SceneInfo info = options.Info();
  waft::VorticesToPolyData({ vortex }, info, vtkPolyData::GetData(outputs));
  waft::RequestedTime(outputs, 0, info.Time);
  return 1;
}

void vtkVortexSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::VortexSourceOptions>(os, indent, *this);
}
