// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSlicedPolyDataAlgorithm.h"

#include "Base/SliceOptions.h"
#include "Bridge/Pipeline/KeptStage.h"
#include "Bridge/Pipeline/StageFailure.h"
#include "Bridge/Pipeline/StageOptions.h"

#include <vtkDataObject.h>

#include <algorithm>

namespace
{

// From which on the time that a work takes can be told.
constexpr double LeastDone = 0.05;
constexpr double LeastSeconds = 1.0;

} // namespace

vtkSlicedPolyDataAlgorithm::vtkSlicedPolyDataAlgorithm() = default;

vtkSlicedPolyDataAlgorithm::~vtkSlicedPolyDataAlgorithm() = default;

void vtkSlicedPolyDataAlgorithm::SetSlice(double seconds)
{
  this->Slice = std::clamp(seconds, 0.0, 1e+09);
}

void vtkSlicedPolyDataAlgorithm::WorkInSlices()
{
  this->SetSlice(0.2);
  this->Kept().WorkBeside();
}

void vtkSlicedPolyDataAlgorithm::GoOn()
{
  this->Kept().GoOn();
}

void vtkSlicedPolyDataAlgorithm::Hold()
{
  this->Kept().Hold();
}

void vtkSlicedPolyDataAlgorithm::LetGo()
{
  for (int port = 0; port < this->GetNumberOfOutputPorts(); ++port)
  {
    if (vtkDataObject* output = this->GetOutputDataObject(port))
    {
      output->Initialize();
    }
  }
  this->Kept().LetGo();
  this->Modified();
}

int vtkSlicedPolyDataAlgorithm::GetComplete()
{
  return waft::HasFailed(this) || this->Kept().IsComplete() ? 1 : 0;
}

int vtkSlicedPolyDataAlgorithm::GetWorkState()
{
  return static_cast<int>(this->Kept().Now());
}

double vtkSlicedPolyDataAlgorithm::GetWorkDone()
{
  return this->Kept().SoFar().Done;
}

std::string vtkSlicedPolyDataAlgorithm::GetWorkText()
{
  const std::string text = this->Kept().SoFar().Text;
  const char* ended = this->GetProgressText();
  return !text.empty() || ended == nullptr ? text : ended;
}

double vtkSlicedPolyDataAlgorithm::GetSecondsLeft()
{
  const waft::SlicedRun::Progress work = this->Kept().SoFar();
  const bool isKnown = work.Done >= 1.0 || (work.Done > LeastDone && work.Seconds > LeastSeconds);
  return isKnown ? work.Seconds * (1.0 - work.Done) / work.Done : -1.0;
}

void vtkSlicedPolyDataAlgorithm::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::SliceOptions>(os, indent, *this);
}
