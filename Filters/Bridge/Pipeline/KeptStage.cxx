// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Pipeline/KeptStage.h"

#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Pipeline/Ranks.h"

#include <vtkAlgorithm.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiProcessController.h>
#include <vtkPolyData.h>

#include <cmath>

namespace waft
{

KeptStage::KeptStage(vtkAlgorithm* stage, int scenePort, int obstaclesPort, int windPort,
                     int airPort) :
  Fields(obstaclesPort, windPort, airPort),
  Stage(stage), ScenePort(scenePort)
{
}

int KeptStage::RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
                                   vtkInformationVector* outputs)
{
  const bool isCurrent = !this->IsActive() || this->Cache.IsCurrent(this->Stage, inputs);
  this->Fields.RequestSteps(this->Stage, request, inputs, outputs, isCurrent);
  return 1;
}

int KeptStage::RequestData(vtkInformation* request, vtkInformationVector** inputs,
                           vtkInformationVector* outputs)
{
  if (!this->IsActive())
  {
    return Empty(outputs);
  }
  if (!this->RunsOnAllRanks() && IsWithFirstRank(vtkDataObject::GetData(inputs[this->ScenePort])))
  {
    return Empty(outputs);
  }
  if (!this->Cache.IsCurrent(this->Stage, inputs))
  {
    Result result = Result::Ok();
    const bool isFirst = this->Fields.IsFirst();
    if (isFirst)
    {
      this->Scene = SceneInfo();
      result = SceneInfoFromFieldData(vtkDataObject::GetData(inputs[this->ScenePort]), this->Scene);
    }
    result = result ? this->Fields.Take(inputs, this->Scene.Time) : result;
    result = result ? this->TakePass(inputs, isFirst) : result;
    const bool hasMore = result && this->Fields.Continue(request);
    if (hasMore && this->GoesOn())
    {
      return 1;
    }
    this->Fields.Reset(request);
    this->Cache.Forget();
    if (hasMore)
    {
      return Empty(outputs); // stopped, and nothing is computed yet
    }
    result = this->Agree(result);
    result = result ? this->Refresh(inputs) : result;
    if (!result)
    {
      return Fail(this->Stage, outputs, result.Message());
    }
    if (!result.IsStopped())
    {
      this->Cache.MarkCurrent(this->Stage, inputs);
    }
  }
  const double time = RequestedTimeOfAll(request, outputs, this->Scene.Time);
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkDataObject* output = vtkDataObject::GetData(outputs, port);
    output->Initialize();
    const auto at = static_cast<std::size_t>(port);
    if (at < this->Keep.size() && this->Keep[at])
    {
      output->ShallowCopy(this->Keep[at]);
    }
  }
  this->FillVarying(time, outputs);
  RequestedTimeOfAll(request, outputs, this->Scene.Time); // filling has cleared the stamps
  return 1;
}

bool KeptStage::GoesOn()
{
  using namespace std::chrono_literals;
  const auto now = std::chrono::steady_clock::now();
  ControllerCommunicator ranks(vtkMultiProcessController::GetGlobalController());
  if (now - this->LastLook < 100ms || ranks.Size() > 1) // which stop together, in Run
  {
    return true;
  }
  this->LastLook = now;
  return StageMonitor(this->Stage).Tick(0.0, "Looking at what moves");
}

Result KeptStage::Refresh(vtkInformationVector** inputs)
{
  this->Keep.clear();
  this->Warnings.clear();
  StageMonitor monitor(this->Stage);
  const Result result = this->Run(inputs, monitor);
  if (result)
  {
    for (const std::string& warning : this->Warnings)
    {
      vtkWarningWithObjectMacro(this->Stage, << warning);
    }
  }
  return result;
}

Result KeptStage::TakePass(vtkInformationVector**, bool)
{
  return Result::Ok();
}

void KeptStage::FillVarying(double, vtkInformationVector*) const {}

Result KeptStage::TakeConstraints(vtkInformationVector* input,
                                  std::vector<Constraint>& constraints) const
{
  vtkPolyData* rows = vtkPolyData::GetData(input);
  if (rows == nullptr || rows->GetNumberOfPoints() == 0)
  {
    return Result::Ok();
  }
  return ConstraintsFromPolyData(rows, this->Scene.Time, constraints);
}

int KeptStage::FrameAt(double time) const
{
  return static_cast<int>(std::lround(time * this->Scene.Time.FramesPerSecond));
}

} // namespace waft
