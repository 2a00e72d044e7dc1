// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLeafShapeSource.h"

#include "Bridge/StageExecution.h"

#include "Shapes/Outline.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkLeafShapeSource);

vtkTypeBool vtkLeafShapeSource::ProcessRequest(vtkInformation* request,
                                               vtkInformationVector** inputs,
                                               vtkInformationVector* outputs)
{
  return waft::GuardedRequest(
    this, request, outputs,
    { { "StemLength", this->StemLength, waft::limits::Finite },
      { "Lobing", this->Lobing, waft::limits::Finite } },
    [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

waft::Result vtkLeafShapeSource::MakeOutline(waft::Outline& outline, std::string& name)
{
  static const char* const names[] = { "leaf", "maple", "oak", "willow", "birch", "aspen" };
  name = names[this->Kind];
  waft::LeafForm form;
  form.Kind = static_cast<waft::LeafKind>(this->Kind);
  form.Width = this->Width;
  form.StemLength = this->StemLength;
  form.Lobing = this->Lobing;
  form.Bend = this->Bend;
  return waft::OutlineOfLeaf(form, outline);
}

void vtkLeafShapeSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Kind: " << this->Kind << "\n";
  os << indent << "StemLength: " << this->StemLength << "\n";
  os << indent << "Lobing: " << this->Lobing << "\n";
}
