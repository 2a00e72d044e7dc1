// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSlicedPolyDataAlgorithm.h"

#include "Base/SliceOptions.h"
#include "Bridge/Pipeline/KeptStage.h"
#include "Bridge/Pipeline/StageFailure.h"
#include "Bridge/Pipeline/StageOptions.h"

#include <algorithm>

vtkSlicedPolyDataAlgorithm::vtkSlicedPolyDataAlgorithm() = default;

vtkSlicedPolyDataAlgorithm::~vtkSlicedPolyDataAlgorithm() = default;

void vtkSlicedPolyDataAlgorithm::SetSlice(double seconds)
{
  this->Slice = std::clamp(seconds, 0.0, 1e+09);
}

void vtkSlicedPolyDataAlgorithm::WorkInSlices()
{
  this->SetSlice(0.2);
}

void vtkSlicedPolyDataAlgorithm::GoOn()
{
  this->Kept().GoOn();
}

int vtkSlicedPolyDataAlgorithm::GetComplete()
{
  return waft::HasFailed(this) || this->Kept().IsComplete() ? 1 : 0;
}

double vtkSlicedPolyDataAlgorithm::GetWorkDone()
{
  return this->Kept().WorkDone();
}

void vtkSlicedPolyDataAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::SliceOptions>(os, indent, *this);
}
