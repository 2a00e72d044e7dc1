// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLeafShapeSource.h"

#include "Shapes/Outline.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkLeafShapeSource);

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
