// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFeatherShapeSource.h"

#include "Base/SceneFrame.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageOptions.h"

#include "Shapes/TextureImage.h"
#include "Shapes/ThinShape.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkFeatherShapeSource);

vtkFeatherShapeSource::vtkFeatherShapeSource()
{
  waft::TakeDefaults<waft::FeatherForm, waft::SceneFrame>(*this);
  waft::CopyFields<waft::SheetOptions>(waft::FeatherSheet(), *this);
  waft::CopyFields<waft::ThinBody>(waft::FeatherBody(), *this);
  waft::CopyFields<waft::SkinOptions>(waft::FeatherSkin(), *this);
}

double vtkFeatherShapeSource::InRange(const char* property, double value)
{
  return waft::InRange<waft::FeatherForm>(property, value);
}

vtkTypeBool vtkFeatherShapeSource::ProcessRequest(vtkInformation* request,
                                                  vtkInformationVector** inputs,
                                                  vtkInformationVector* outputs)
{
  return waft::GuardedRequest(
    this, request, outputs,
    waft::RangesOf<waft::FeatherForm, waft::SheetOptions, waft::ThinBody, waft::SkinOptions,
                   waft::SceneFrame>(*this),
    [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

waft::Result vtkFeatherShapeSource::MakeOutline(waft::Outline& outline, std::string& name)
{
  static const char* const names[] = { "feather", "contour", "down" };
  name = names[this->Kind];
  return waft::OutlineOfFeather(waft::OptionsOf<waft::FeatherForm>(*this), outline);
}

void vtkFeatherShapeSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::FeatherForm, waft::SheetOptions, waft::ThinBody, waft::SkinOptions,
                    waft::SceneFrame>(os, indent, *this);
}
