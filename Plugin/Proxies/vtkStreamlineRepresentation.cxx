// SPDX-License-Identifier: BSD-3-Clause
#include "vtkStreamlineRepresentation.h"

#include "vtkStreamlineTubes.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkStreamlineRepresentation);

vtkStreamlineRepresentation::vtkStreamlineRepresentation()
{
  this->GeometryFilter->Delete();
  this->GeometryFilter = vtkStreamlineTubes::New();
  this->SetupDefaults();
}

vtkStreamlineRepresentation::~vtkStreamlineRepresentation() = default;

void vtkStreamlineRepresentation::SetNumberOfLines(int lines)
{
  static_cast<vtkStreamlineTubes*>(this->GeometryFilter)->SetNumberOfLines(lines);
  this->MarkModified();
}

void vtkStreamlineRepresentation::SetLineLength(double share)
{
  static_cast<vtkStreamlineTubes*>(this->GeometryFilter)->SetLineLength(share);
  this->MarkModified();
}

void vtkStreamlineRepresentation::SetTubeRadius(double share)
{
  static_cast<vtkStreamlineTubes*>(this->GeometryFilter)->SetTubeRadius(share);
  this->MarkModified();
}

void vtkStreamlineRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->GeometryFilter->PrintSelf(os, indent.GetNextIndent());
}
