// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Pipeline/TimeSweep.h"

#include "Bridge/Pipeline/StageFailure.h"
#include "Bridge/Pipeline/StageTimes.h"
#include "Bridge/Pipeline/Upstream.h"

#include <vtkAlgorithm.h>
#include <vtkDataObject.h>
#include <vtkInformation.h>
#include <vtkInformationIntegerKey.h>
#include <vtkInformationKeyLookup.h>
#include <vtkInformationVector.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>

namespace waft
{
namespace
{

using Sddp = vtkStreamingDemandDrivenPipeline;

// Looked up by name: every module that this library is part of would have a key of its own.
vtkInformationIntegerKey* StandsStillKey()
{
  vtkInformationKey* known = vtkInformationKeyLookup::Find("STANDS_STILL", "waft");
  return known ? static_cast<vtkInformationIntegerKey*>(known)
               : vtkInformationIntegerKey::MakeKey("STANDS_STILL", "waft");
}

bool StandsStill(vtkInformation* input)
{
  vtkInformation* produced = ProducedInformation(input);
  return produced != nullptr && produced->Get(StandsStillKey()) != 0;
}

bool HasDataTime(vtkInformation* input)
{
  vtkDataObject* data = vtkDataObject::GetData(input);
  return data && data->GetInformation()->Has(vtkDataObject::DATA_TIME_STEP());
}

} // namespace

void TimeSweep::RequestSteps(vtkAlgorithm* stage, vtkInformation* request,
                             vtkInformationVector** inputs, vtkInformationVector* outputs,
                             bool isCurrent)
{
  if (HasFailed(stage)) // in the middle of an earlier sweep, perhaps
  {
    this->Step = 0;
  }
  if (this->Step == 0)
  {
    this->NumberOfSteps = 1;
    for (const int port : this->Ports)
    {
      for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
      {
        vtkInformation* input = inputs[port]->GetInformationObject(i);
        const int steps = StandsStill(input) ? 1 : input->Length(Sddp::TIME_STEPS());
        this->NumberOfSteps = std::max(this->NumberOfSteps, static_cast<std::size_t>(steps));
      }
    }
  }
  const bool isPulling = !isCurrent && this->NumberOfSteps > 1 && this->HasNewStep();
  vtkInformation* output = outputs->GetInformationObject(AskingPort(request));
  const bool mayMislead = isPulling && HasCommonUpstream(stage, inputs);
  this->MustReturn = false;
  for (int port = 0; port < stage->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkInformation* input = inputs[port]->GetInformationObject(i);
      const int steps = input->Length(Sddp::TIME_STEPS());
      if (steps == 0)
      {
        continue;
      }
      const double* times = input->Get(Sddp::TIME_STEPS());
      const double asked = steps > 1 && output->Has(Sddp::UPDATE_TIME_STEP())
                             ? output->Get(Sddp::UPDATE_TIME_STEP())
                             : times[0];
      const bool rests = isCurrent && HasDataTime(input) && IsOnlyConsumer(stage, input);
      const double due = isPulling ? times[std::min(static_cast<int>(this->Step), steps - 1)]
                         : rests   ? DataTime(input)
                                   : asked;
      this->MustReturn = this->MustReturn || (mayMislead && due != asked);
      input->Set(Sddp::UPDATE_TIME_STEP(), due);
    }
  }
}

double TimeSweep::DataTime(vtkInformation* input)
{
  return HasDataTime(input)
           ? vtkDataObject::GetData(input)->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP())
           : 0.0;
}

double TimeSweep::Fraction() const
{
  return static_cast<double>(this->Step) / static_cast<double>(this->NumberOfSteps);
}

bool TimeSweep::Continue(vtkInformation* request)
{
  if (this->Step + 1 < this->NumberOfSteps || (this->HasNewStep() && this->MustReturn))
  {
    ++this->Step;
    request->Set(Sddp::CONTINUE_EXECUTING(), 1);
    return true;
  }
  this->Reset(request);
  return false;
}

bool TimeSweep::Pause(vtkInformation* request)
{
  const bool goesOn = this->Continue(request);
  request->Remove(Sddp::CONTINUE_EXECUTING());
  return goesOn;
}

bool TimeSweep::Leave(vtkInformation* request)
{
  this->Step = std::max(this->Step, this->NumberOfSteps - 1);
  return this->Continue(request);
}

void TimeSweep::Reset(vtkInformation* request)
{
  this->Step = 0;
  request->Remove(Sddp::CONTINUE_EXECUTING());
}

void SetStandsStill(vtkInformation* output, bool standsStill)
{
  output->Set(StandsStillKey(), standsStill);
}

} // namespace waft
