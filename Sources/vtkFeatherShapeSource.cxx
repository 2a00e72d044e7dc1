// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFeatherShapeSource.h"

#include "Bridge/StageExecution.h"

#include "Shapes/Outline.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkFeatherShapeSource);

vtkFeatherShapeSource::vtkFeatherShapeSource()
{
  this->Length = 0.2;
  this->Curl = 0.5;
  this->Camber = 0.1;
  this->Twist = 0.15;
  this->AreaDensity = 0.04;
  this->Thickness = 0.0005;
  this->SettlingSpeed = 0.4;
  this->Rows = 36;
  this->Blotches = 0.9;
  const double base[3] = { 0.93, 0.90, 0.84 };
  const double edge[3] = { 0.44, 0.31, 0.22 };
  const double shaft[3] = { 0.90, 0.84, 0.72 };
  this->SetBaseColor(base);
  this->SetEdgeColor(edge);
  this->SetVeinColor(shaft);
}

vtkTypeBool vtkFeatherShapeSource::ProcessRequest(vtkInformation* request,
                                                  vtkInformationVector** inputs,
                                                  vtkInformationVector* outputs)
{
  return waft::GuardedRequest(
    this, request, outputs,
    { { "ShaftLength", this->ShaftLength, waft::limits::Finite },
      { "Asymmetry", this->Asymmetry, waft::limits::Finite } },
    [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

waft::Result vtkFeatherShapeSource::MakeOutline(waft::Outline& outline, std::string& name)
{
  static const char* const names[] = { "feather", "contour", "down" };
  name = names[this->Kind];
  waft::FeatherForm form;
  form.Kind = static_cast<waft::FeatherKind>(this->Kind);
  form.Width = this->Width;
  form.ShaftLength = this->ShaftLength;
  form.Asymmetry = this->Asymmetry;
  form.Bend = this->Bend;
  return waft::OutlineOfFeather(form, outline);
}

void vtkFeatherShapeSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Kind: " << this->Kind << "\n";
  os << indent << "ShaftLength: " << this->ShaftLength << "\n";
  os << indent << "Asymmetry: " << this->Asymmetry << "\n";
}
