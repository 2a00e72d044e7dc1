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

vtkStreamlineTubes* vtkStreamlineRepresentation::Tubes()
{
  return static_cast<vtkStreamlineTubes*>(this->GeometryFilter);
}

void vtkStreamlineRepresentation::SetNumberOfLines(int lines)
{
  this->Tubes()->SetNumberOfLines(lines);
  this->MarkModified();
}

void vtkStreamlineRepresentation::SetLineLength(double share)
{
  this->Tubes()->SetLineLength(share);
  this->MarkModified();
}

void vtkStreamlineRepresentation::SetTubeRadius(double share)
{
  this->Tubes()->SetTubeRadius(share);
  this->MarkModified();
}

void vtkStreamlineRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->GeometryFilter->PrintSelf(os, indent.GetNextIndent());
}
