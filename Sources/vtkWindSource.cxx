// SPDX-License-Identifier: BSD-3-Clause
#include "vtkWindSource.h"

#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Files/SceneFiles.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Scene/ForceOptions.h"
#include "Scene/SceneWind.h"

#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkStreamingDemandDrivenPipeline.h>

vtkStandardNewMacro(vtkWindSource);

namespace
{

waft::Result MakeWind(const waft::WindSourceOptions& options, waft::Scene& scene,
                      waft::SceneWind& wind)
{
  scene.Info = options.Info();
  WAFT_RETURN_IF_FAILED(options.Make(scene));
  return wind.Build(scene, waft::VtkSceneAssets());
}

} // namespace

vtkWindSource::vtkWindSource()
{
  waft::TakeDefaults<waft::WindSourceOptions>(*this);
  this->SetNumberOfInputPorts(0);
}

double vtkWindSource::InRange(const char* property, double value)
{
  return waft::InRange<waft::WindSourceOptions>(property, value);
}

vtkTypeBool vtkWindSource::ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                                          vtkInformationVector* outputs)
{
  return waft::GuardedRequest(
    this, request, outputs, waft::RangesOf<waft::WindSourceOptions>(*this),
    [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

int vtkWindSource::RequestInformation(vtkInformation*, vtkInformationVector**,
                                      vtkInformationVector* outputs)
{
  waft::Scene scene;
  waft::SceneWind wind;
  int extent[6] = { 0, -1, 0, -1, 0, -1 };
  if (MakeWind(waft::OptionsOf<waft::WindSourceOptions>(*this), scene, wind))
  {
    wind.WholeExtent(extent);
  }
  waft::SetTimeSteps(scene.Info.Time, outputs);
  outputs->GetInformationObject(0)->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent,
                                        6);
  return 1;
}

int vtkWindSource::RequestData(vtkInformation*, vtkInformationVector**,
                               vtkInformationVector* outputs)
{
  waft::Scene scene;
  waft::SceneWind wind;
  if (const waft::Result made =
        MakeWind(waft::OptionsOf<waft::WindSourceOptions>(*this), scene, wind);
      !made)
  {
    return waft::Fail(this, outputs, made.Message());
  }
  vtkImageData* image = vtkImageData::GetData(outputs);
  const double time = waft::RequestedTime(outputs, 0, scene.Info.Time);
  waft::FieldSeriesToImage(wind.At(time), time, scene.Info, image);
  waft::AuthoredToFieldData(waft::AuthoredWinds(scene), image);
  (void)waft::RequestedTime(outputs, 0, scene.Info.Time); // filling has cleared the stamp
  return 1;
}

void vtkWindSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::WindSourceOptions>(os, indent, *this);
}
