// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSlicedPolyDataAlgorithm.h"

#include "Bridge/Pipeline/SlicedStage.h"
#include "Bridge/Pipeline/StageOptions.h"

WaftSlicesOf(vtkSlicedPolyDataAlgorithm);

vtkSlicedPolyDataAlgorithm::vtkSlicedPolyDataAlgorithm() = default;

vtkSlicedPolyDataAlgorithm::~vtkSlicedPolyDataAlgorithm() = default;

void vtkSlicedPolyDataAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::SliceOptions>(os, indent, *this);
}
