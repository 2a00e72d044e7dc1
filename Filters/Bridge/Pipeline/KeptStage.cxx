// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Pipeline/KeptStage.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Arrays.h"
#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Pipeline/Ranks.h"
#include "Bridge/Pipeline/StageInputs.h"

#include <vtkAlgorithm.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiProcessController.h>
#include <vtkPolyData.h>

#include <cmath>
#include <utility>

namespace waft
{

namespace
{

// Of a slice: a first picture waits for the first slices of all stages of a pipeline.
constexpr double FirstSlice = 0.25;
constexpr double OneTick = 1e-9; // s, of work that is caught where it ticks next
// From which on the time that a work takes can be told.
constexpr double LeastDone = 0.05;
constexpr double LeastSeconds = 1.0;

bool IsComplete(vtkDataObject* data)
{
  double complete = 1.0;
  return data == nullptr ||
         !ReadNumber(data->GetFieldData(), "field data", names::Complete, { 0, 1 }, complete) ||
         complete > 0.0;
}

} // namespace

bool HasUnfinishedInput(vtkAlgorithm* stage, vtkInformationVector** inputs)
{
  for (int port = 0; port < stage->GetNumberOfInputPorts(); ++port)
  {
    for (int i = 0; i < inputs[port]->GetNumberOfInformationObjects(); ++i)
    {
      if (!IsComplete(vtkDataObject::GetData(inputs[port], i)))
      {
        return true;
      }
    }
  }
  return false;
}

void MarkUnfinished(vtkInformationVector* outputs)
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    AddInts(vtkDataObject::GetData(outputs, port)->GetFieldData(), names::Complete, { 0 });
  }
}

KeptStage::KeptStage(vtkAlgorithm* stage, int scenePort, int obstaclesPort, int windPort,
                     int airPort) :
  Fields(obstaclesPort, windPort, airPort),
  Stage(stage), ScenePort(scenePort)
{
  ChooseThreads();
}

int KeptStage::RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
                                   vtkInformationVector* outputs)
{
  const bool isCurrent =
    !this->IsActive() || this->Giver || this->Cache.IsCurrent(this->Stage, inputs);
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
  if (!this->RunsOnAllRanks() && this->IsElsewhere(inputs))
  {
    return Empty(outputs);
  }
  if (this->Giver)
  {
    if (const Result result = this->TakeGiven(inputs); !result)
    {
      return this->FailWith(result, outputs);
    }
  }
  else if (!this->Cache.IsCurrent(this->Stage, inputs))
  {
    this->Discard();
    this->IsUnfinished = HasUnfinishedInput(this->Stage, inputs);
    if (this->IsUnfinished)
    {
      if (this->Fields.Leave(request))
      {
        return 1;
      }
      this->Keep.clear();
      if (!this->TakeScene(inputs) || !this->PublishFrom(inputs))
      {
        this->Keep.clear();
      }
      this->Cache.MarkCurrent(this->Stage, inputs);
    }
    else
    {
      Result result = Result::Ok();
      const bool isFirst = this->Fields.IsFirst();
      if (isFirst)
      {
        result = this->TakeScene(inputs);
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
      result = result ? this->Begin(inputs) : result;
      if (!result)
      {
        return this->FailWith(result, outputs);
      }
    }
  }
  else if (std::exchange(this->IsDue, false) && this->Held.HasWork())
  {
    this->Cache.Forget();
    const double slice = this->SliceNow();
    const bool isBeside = this->IsBeside && slice > 0.0;
    const Result result = isBeside && this->Held.Now() == SlicedRun::State::Held
                            ? this->PublishHeld(inputs)
                            : this->Advance(inputs, isBeside ? OneTick : slice);
    if (!result)
    {
      return this->FailWith(result, outputs);
    }
  }
  this->Show(request, outputs);
  return 1;
}

int KeptStage::FailWith(const Result& result, vtkInformationVector* outputs)
{
  const int done = Fail(this->Stage, outputs, result.Message());
  this->Keep.clear();
  this->KeepBeforeFailure();
  this->GiveKept(outputs);
  return done;
}

void KeptStage::GiveKept(vtkInformationVector* outputs) const
{
  for (std::size_t port = 0; port < this->Keep.size(); ++port)
  {
    if (this->Keep[port])
    {
      vtkDataObject::GetData(outputs, static_cast<int>(port))->ShallowCopy(this->Keep[port]);
    }
  }
}

void KeptStage::Show(vtkInformation* request, vtkInformationVector* outputs)
{
  const double time =
    this->HasTime() ? RequestedTimeOfAll(request, outputs, this->Scene.Time) : 0.0;
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkDataObject::GetData(outputs, port)->Initialize();
  }
  this->GiveKept(outputs);
  if (this->IsUnfinished)
  {
    this->FillPublished(time, outputs);
    MarkUnfinished(outputs);
  }
  else
  {
    this->FillVarying(time, outputs);
  }
  if (this->HasTime())
  {
    RequestedTimeOfAll(request, outputs, this->Scene.Time); // filling has cleared the stamps
  }
}

Result KeptStage::TakeScene(vtkInformationVector** inputs)
{
  if (this->ScenePort == FieldSweep::NoPort)
  {
    return Result::Ok();
  }
  this->Scene = SceneInfo();
  std::set<std::string> lacking;
  const Result result = SceneOfInputs(this->Stage, inputs, this->ScenePort, this->Scene, lacking);
  // Of the other ranks the first one's scene is theirs as well.
  this->Defaults = this->IsElsewhere(inputs) ? "" : DefaultsText(lacking, this->Scene);
  return result;
}

bool KeptStage::IsElsewhere(vtkInformationVector** inputs) const
{
  return this->ScenePort != FieldSweep::NoPort &&
         IsWithFirstRank(vtkDataObject::GetData(inputs[this->ScenePort]));
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
  StageMonitor monitor(this->Stage);
  const bool goesOn = monitor.Tick(0.0, "Looking at what moves");
  if (goesOn)
  {
    monitor.Hold();
  }
  return goesOn;
}

double KeptStage::SliceNow() const
{
  // Several ranks, which wait for each other at places of their own, do it all at once.
  ControllerCommunicator ranks(vtkMultiProcessController::GetGlobalController());
  return ranks.Size() > 1 ? 0.0 : this->Slice();
}

Result KeptStage::Begin(vtkInformationVector** inputs)
{
  this->Warnings.clear();
  if (this->SliceNow() > 0.0)
  {
    this->Held.Begin([this, inputs](Monitor& monitor) { return this->Run(inputs, monitor); });
    return this->Advance(inputs, this->IsBeside ? OneTick : FirstSlice * this->SliceNow());
  }
  this->Keep.clear();
  StageMonitor monitor(this->Stage);
  return this->End(inputs, this->Run(inputs, monitor));
}

Result KeptStage::Advance(vtkInformationVector** inputs, double seconds)
{
  this->Keep.clear();
  StageMonitor monitor(this->Stage);
  Result result = Result::Ok();
  this->IsUnfinished = !this->Held.GoOn(seconds, monitor, result);
  if (!this->IsUnfinished)
  {
    this->Reached = SlicedRun::Progress();
    this->Reached.Done = 1.0;
    return this->End(inputs, result);
  }
  monitor.Hold();
  return this->PublishHeld(inputs);
}

Result KeptStage::PublishHeld(vtkInformationVector** inputs)
{
  this->Keep.clear();
  this->Publish();
  if (this->IsBeside)
  {
    this->Held.LetGo();
  }
  this->Cache.MarkCurrent(this->Stage, inputs);
  return Result::Ok();
}

Result KeptStage::End(vtkInformationVector** inputs, const Result& result)
{
  if (!result)
  {
    return result;
  }
  if (!this->Defaults.empty())
  {
    vtkWarningWithObjectMacro(this->Stage, << this->Defaults);
  }
  for (const std::string& warning : this->Warnings)
  {
    vtkWarningWithObjectMacro(this->Stage, << warning);
  }
  if (!result.IsStopped())
  {
    this->Cache.MarkCurrent(this->Stage, inputs);
  }
  GiveMemoryBack();
  return result;
}

void KeptStage::Give(vtkAlgorithm* giver, const waft::Scene& scene, const Motion& motion)
{
  this->Giver = giver;
  this->GivenScene = &scene;
  this->GivenMotion = &motion;
  this->Stage->Modified();
}

Result KeptStage::TakeGiven(vtkInformationVector** inputs)
{
  const vtkSmartPointer<vtkAlgorithm> giver = this->Giver;
  this->Giver = nullptr;
  this->Discard();
  this->IsUnfinished = false;
  this->Warnings.clear();
  this->Keep.clear();
  WAFT_RETURN_IF_FAILED(this->TakeScene(inputs));
  WAFT_RETURN_IF_FAILED(this->Adopt(inputs, *this->GivenScene, *this->GivenMotion));
  this->Cache.MarkCurrent(this->Stage, inputs);
  return Result::Ok();
}

Result KeptStage::Adopt(vtkInformationVector**, const waft::Scene&, const Motion&)
{
  return Result::Ok();
}

void KeptStage::Discard()
{
  if (this->Held.HasWork())
  {
    this->Held.Discard();
  }
}

void KeptStage::LetGo()
{
  this->Held.Discard();
  this->Keep.clear();
  this->Clear();
  this->Cache.Forget();
  this->IsUnfinished = false;
  GiveMemoryBack();
}

void KeptStage::GoOn()
{
  if (this->Held.HasWork())
  {
    this->IsDue = true;
    this->Cache.Reawaken(this->Stage);
  }
}

SlicedRun::Progress KeptStage::SoFar() const
{
  return this->Held.HasWork() ? this->Held.SoFar() : this->Reached;
}

double KeptStage::SecondsLeft() const
{
  const SlicedRun::Progress work = this->SoFar();
  const bool isKnown = work.Done >= 1.0 || (work.Done > LeastDone && work.Seconds > LeastSeconds);
  return isKnown ? work.Seconds * (1.0 - work.Done) / work.Done : -1.0;
}

Result KeptStage::TakePass(vtkInformationVector**, bool)
{
  return Result::Ok();
}

Result KeptStage::PublishFrom(vtkInformationVector**)
{
  return Result::Ok();
}

void KeptStage::FillVarying(double, vtkInformationVector*) const {}

void KeptStage::FillPublished(double, vtkInformationVector*) const {}

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
