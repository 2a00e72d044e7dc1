// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLeafShapeSource.h"

#include "Base/SceneFrame.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageOptions.h"

#include "Shapes/TextureImage.h"
#include "Shapes/ThinShape.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkLeafShapeSource);

vtkLeafShapeSource::vtkLeafShapeSource()
{
  waft::TakeDefaults<waft::LeafForm, waft::SheetOptions, waft::ThinBody, waft::SkinOptions,
                     waft::SceneFrame>(*this);
}

double vtkLeafShapeSource::InRange(const char* property, double value)
{
  return waft::InRange<waft::LeafForm>(property, value);
}

vtkTypeBool vtkLeafShapeSource::ProcessRequest(vtkInformation* request,
                                               vtkInformationVector** inputs,
                                               vtkInformationVector* outputs)
{
  return waft::GuardedRequest(
    this, request, outputs,
    waft::RangesOf<waft::LeafForm, waft::SheetOptions, waft::ThinBody, waft::SkinOptions,
                   waft::SceneFrame>(*this),
    [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

waft::Result vtkLeafShapeSource::MakeOutline(waft::Outline& outline, std::string& name)
{
  static const char* const names[] = { "leaf", "maple", "oak", "willow", "birch", "aspen" };
  name = names[this->Kind];
  return waft::OutlineOfLeaf(waft::OptionsOf<waft::LeafForm>(*this), outline);
}

void vtkLeafShapeSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::LeafForm, waft::SheetOptions, waft::ThinBody, waft::SkinOptions,
                    waft::SceneFrame>(os, indent, *this);
}
