// SPDX-License-Identifier: BSD-3-Clause
#include "vtkObjectSource.h"

#include "Bridge/Data/SceneData.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Scene/ObjectOptions.h"

#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>

vtkStandardNewMacro(vtkObjectSource);

vtkObjectSource::vtkObjectSource()
{
  this->SetNumberOfInputPorts(0);
}

vtkTypeBool vtkObjectSource::ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                                            vtkInformationVector* outputs)
{
  return waft::GuardedRequest(
    this, request, outputs, waft::RangesOf<waft::ObjectOptions>(*this),
    [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

int vtkObjectSource::RequestInformation(vtkInformation*, vtkInformationVector**,
                                        vtkInformationVector* outputs)
{
  waft::SetTimeSteps(waft::OptionsOf<waft::SceneFrame>(*this).Info().Time, outputs);
  return 1;
}

int vtkObjectSource::RequestData(vtkInformation*, vtkInformationVector**,
                                 vtkInformationVector* outputs)
{
  const auto options = waft::OptionsOf<waft::ObjectOptions>(*this);
  const waft::SceneInfo info = options.Info();
  std::vector<waft::MotionObject> objects;
  if (const waft::Result made = options.MakeObjects(objects); !made)
  {
    return waft::Fail(this, outputs, made.Message());
  }
  waft::ObjectsToPolyData(objects, info, vtkPolyData::GetData(outputs), options.ObjectId >= 0);
  waft::RequestedTime(outputs, 0, info.Time);
  return 1;
}

void vtkObjectSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::ObjectOptions>(os, indent, *this);
}
