// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSpiralRepresentation.h"

#include "vtkVortexSpirals.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkSpiralRepresentation);

vtkSpiralRepresentation::vtkSpiralRepresentation()
{
  this->GeometryFilter->Delete();
  this->GeometryFilter = vtkVortexSpirals::New();
  this->SetupDefaults();
}

vtkSpiralRepresentation::~vtkSpiralRepresentation() = default;

void vtkSpiralRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->GeometryFilter->PrintSelf(os, indent.GetNextIndent());
}
