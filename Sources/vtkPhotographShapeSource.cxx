// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPhotographShapeSource.h"

#include "Base/SceneFrame.h"
#include "Bridge/Files/PhotographShape.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Shapes/ThinShape.h"

#include <vtkObjectFactory.h>

#include <filesystem>

vtkStandardNewMacro(vtkPhotographShapeSource);

vtkPhotographShapeSource::vtkPhotographShapeSource()
{
  waft::TakeDefaults<waft::PhotographFile, waft::PhotographOptions, waft::ThinBody,
                     waft::SceneFrame>(*this);
}

double vtkPhotographShapeSource::InRange(const char* property, double value)
{
  return waft::InRange<waft::PhotographOptions>(property, value);
}

vtkTypeBool vtkPhotographShapeSource::ProcessRequest(vtkInformation* request,
                                                     vtkInformationVector** inputs,
                                                     vtkInformationVector* outputs)
{
  return waft::GuardedRequest(
    this, request, outputs,
    waft::RangesOf<waft::PhotographFile, waft::PhotographOptions, waft::ThinBody, waft::SceneFrame>(
      *this),
    [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

waft::Result vtkPhotographShapeSource::MakeShape(waft::Shape& shape)
{
  if (this->Photograph.empty())
  {
    return waft::Result::Error("Photograph: expected the name of a picture");
  }
  const waft::Result made = waft::LoadPhotographShape(
    this->Photograph, waft::OptionsOf<waft::PhotographOptions>(*this), shape);
  if (!made)
  {
    return waft::Result::Error("Photograph " + this->Photograph + ": " + made.Message());
  }
  shape.Name = std::filesystem::path(this->Photograph).stem().string();
  return waft::Result::Ok();
}

void vtkPhotographShapeSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::PhotographFile, waft::PhotographOptions, waft::ThinBody,
                    waft::SceneFrame>(os, indent, *this);
}
