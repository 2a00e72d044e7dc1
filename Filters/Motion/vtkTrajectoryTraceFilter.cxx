// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTrajectoryTraceFilter.h"

#include "Base/SliceOptions.h"
#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Arrays.h"
#include "Bridge/Data/Blocks.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/FlowData.h"
#include "Bridge/Data/ImageLattice.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/TrackData.h"
#include "Bridge/Data/VortexData.h"
#include "Bridge/Pipeline/KeptStage.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageInputs.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Obstacles/ObstacleSet.h"

#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkTrajectoryTraceFilter);

namespace
{

enum InputPort
{
  FlowPort,
  VorticesPort,
  ObstaclesPort,
  NumberOfInputs
};

constexpr const char* Doing = "Tracing trajectories";

using waft::StageInput;

const waft::StageInputs Inputs = {
  { "Input", StageInput::Type::Image },
  { "Vortices", StageInput::Type::Merged, StageInput::Number::Optional },
  { "Obstacles", StageInput::Type::Surfaces, StageInput::Number::Optional },
};

} // namespace

struct vtkTrajectoryTraceFilter::Internals
{
  using Clock = std::chrono::steady_clock;

  waft::StageCache Cache;
  waft::TimeSweep Sweep{ { FlowPort, ObstaclesPort } };
  waft::TrajectoryTracer Tracer;
  waft::PointLattice Lattice;
  waft::SolidVoxels Solid;     // as the flow says at the present step
  waft::ObstacleSet Obstacles; // as they stand at the present step
  std::vector<vtkMTimeType> ObstacleChange;
  double LastTime = 0.0;
  waft::SceneInfo Info;
  vtkNew<vtkPolyData> Tracks;
  // Of work in slices.
  enum class Work
  {
    None,
    Waits, // for an input that is not complete
    Paused,
    Held // paused, and not to go on
  };
  Work Now = Work::None;
  waft::StageCache Paused; // for what the sweep has come so far
  bool IsWithin = false;   // an update
  Clock::time_point Began; // the update
  double Worked = 0.0;     // s

  waft::Result Begin(vtkAlgorithm* stage, vtkInformationVector** inputs,
                     const waft::TraceOptions& options);
  waft::Result UpdateObstacles(vtkDataObject* data);
  waft::Result Feed(vtkInformationVector** inputs, bool isFirst);
  waft::Result FeedSteady(vtkInformationVector** inputs);
  bool IsUnfinished() const { return this->Now != Work::None; }
  /// Begins an update where none is begun; seconds since it began.
  double SinceBegin();
  /// Of an update, with more to be done in the next.
  int Leave(Work now, vtkInformationVector* outputs);
  void StartAnew();
};

double vtkTrajectoryTraceFilter::Internals::SinceBegin()
{
  const Clock::time_point now = Clock::now();
  if (!this->IsWithin)
  {
    this->IsWithin = true;
    this->Began = now;
  }
  return std::chrono::duration<double>(now - this->Began).count();
}

int vtkTrajectoryTraceFilter::Internals::Leave(Work now, vtkInformationVector* outputs)
{
  this->Now = now;
  this->IsWithin = false;
  vtkPolyData::GetData(outputs)->Initialize();
  waft::MarkUnfinished(outputs);
  return 1;
}

void vtkTrajectoryTraceFilter::Internals::StartAnew()
{
  this->Sweep = waft::TimeSweep({ FlowPort, ObstaclesPort });
  this->Now = Work::None;
  this->IsWithin = false;
  this->Worked = 0.0;
}

namespace
{

// The scene of the flow: its field data, else the image's bounds and the rate of its time steps.
waft::Result SceneOfFlow(vtkAlgorithm* stage, vtkInformationVector** inputs, waft::SceneInfo& info)
{
  vtkInformation* input = inputs[FlowPort]->GetInformationObject(0);
  vtkImageData* image = vtkImageData::GetData(input);
  double b[6];
  image->GetBounds(b);
  info.Bounds = waft::Box{ waft::Vec3(b[0], b[2], b[4]), waft::Vec3(b[1], b[3], b[5]) };
  const int steps = input->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
  if (steps > 1)
  {
    const double* times = input->Get(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
    info.Time.NumberOfFrames = steps;
    info.Time.FramesPerSecond = (steps - 1) / (times[steps - 1] - times[0]);
  }
  std::set<std::string> lacking;
  const waft::Result result = waft::SceneOfInputs(stage, inputs, FlowPort, info, lacking);
  lacking.erase(waft::names::Bounds);
  lacking.erase(waft::names::Seed); // nothing here is random
  if (steps < 2 && result && !lacking.empty())
  {
    vtkWarningWithObjectMacro(stage, << waft::DefaultsText(lacking, info));
  }
  return result;
}

} // namespace

waft::Result vtkTrajectoryTraceFilter::Internals::Begin(vtkAlgorithm* stage,
                                                        vtkInformationVector** inputs,
                                                        const waft::TraceOptions& options)
{
  vtkImageData* image = vtkImageData::GetData(inputs[FlowPort]);
  this->Info = waft::SceneInfo();
  WAFT_RETURN_IF_FAILED(waft::LatticeFromImage(image, "Input", this->Lattice));
  WAFT_RETURN_IF_FAILED(SceneOfFlow(stage, inputs, this->Info));
  std::vector<waft::Vortex> vortices;
  if (vtkPolyData* lines = vtkPolyData::GetData(inputs[VorticesPort]))
  {
    WAFT_RETURN_IF_FAILED(waft::VorticesFromPolyData(lines, vortices));
  }
  waft::TraceOptions trace = options;
  trace.FramesPerSecond = this->Info.Time.FramesPerSecond;
  trace.Volume = this->Info.Bounds;
  this->Obstacles = waft::ObstacleSet();
  this->ObstacleChange.clear();
  const waft::SolidTest isSolid = [this](const waft::Vec3& x, double)
  {
    return this->Solid.Contains(x) ||
           (!this->Obstacles.IsEmpty() && this->Obstacles.SignedDistance(x, 0.0, 0.0) < 0.0);
  };
  return this->Tracer.Begin(this->Lattice, trace, std::move(vortices), isSolid);
}

waft::Result vtkTrajectoryTraceFilter::Internals::UpdateObstacles(vtkDataObject* data)
{
  if (data == nullptr)
  {
    return waft::Result::Ok();
  }
  std::vector<vtkPolyData*> surfaces;
  WAFT_RETURN_IF_FAILED(waft::SurfacesOf(data, "Obstacles", surfaces));
  std::vector<vtkMTimeType> change = waft::PointChanges(surfaces);
  if (change == this->ObstacleChange)
  {
    return waft::Result::Ok();
  }
  this->ObstacleChange = std::move(change);
  waft::ObstacleCollector collector;
  WAFT_RETURN_IF_FAILED(collector.Add(data, 0.0, this->Info.Time));
  return this->Obstacles.Build(collector.Take());
}

waft::Result vtkTrajectoryTraceFilter::Internals::Feed(vtkInformationVector** inputs, bool isFirst)
{
  const double time = waft::TimeSweep::DataTime(inputs[FlowPort]->GetInformationObject(0));
  if (!isFirst && time <= this->LastTime)
  {
    return waft::Result::Ok(); // the obstacles have more steps than the flow
  }
  WAFT_RETURN_IF_FAILED(this->UpdateObstacles(vtkDataObject::GetData(inputs[ObstaclesPort])));
  vtkImageData* image = vtkImageData::GetData(inputs[FlowPort]);
  waft::SolidVoxelsFromImage(image, this->Lattice, this->Solid);
  waft::FlowFrame frame;
  WAFT_RETURN_IF_FAILED(waft::FlowFrameFromImage(image, time, frame));
  this->LastTime = time;
  return this->Tracer.Feed(std::move(frame), waft::SmpFor());
}

waft::Result vtkTrajectoryTraceFilter::Internals::FeedSteady(vtkInformationVector** inputs)
{
  vtkInformation* input = inputs[FlowPort]->GetInformationObject(0);
  if (input->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS()) > 1 ||
      this->Info.Time.NumberOfFrames < 2)
  {
    return waft::Result::Ok();
  }
  waft::FlowFrame frame;
  const double end = this->LastTime + this->Info.Time.Time(this->Info.Time.NumberOfFrames - 1);
  WAFT_RETURN_IF_FAILED(
    waft::FlowFrameFromImage(vtkImageData::GetData(inputs[FlowPort]), end, frame));
  return this->Tracer.Feed(std::move(frame), waft::SmpFor());
}

vtkTrajectoryTraceFilter::vtkTrajectoryTraceFilter() : Impl(std::make_unique<Internals>())
{
  waft::TakeDefaults<waft::TraceOptions, waft::AnnotationOptions>(*this);
  this->SetNumberOfInputPorts(NumberOfInputs);
}

vtkTrajectoryTraceFilter::~vtkTrajectoryTraceFilter() = default;

double vtkTrajectoryTraceFilter::InRange(const char* property, double value)
{
  return waft::InRange<waft::TraceOptions, waft::AnnotationOptions>(property, value);
}

int vtkTrajectoryTraceFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  return waft::FillInput(Inputs, port, info);
}

vtkTypeBool vtkTrajectoryTraceFilter::ProcessRequest(vtkInformation* request,
                                                     vtkInformationVector** inputs,
                                                     vtkInformationVector* outputs)
{
  return waft::GuardedRequest(
    this, request, inputs, outputs, Inputs,
    waft::RangesOf<waft::TraceOptions, waft::AnnotationOptions, waft::SliceOptions>(*this),
    [&](vtkInformationVector** taken)
    { return this->Superclass::ProcessRequest(request, taken, outputs); });
}

int vtkTrajectoryTraceFilter::RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                                                 vtkInformationVector* outputs)
{
  waft::PassTimeSteps(this, inputs, outputs);
  return 1;
}

int vtkTrajectoryTraceFilter::RequestUpdateExtent(vtkInformation* request,
                                                  vtkInformationVector** inputs,
                                                  vtkInformationVector* outputs)
{
  if (this->Impl->IsUnfinished() && !this->Impl->Paused.IsCurrent(this, inputs))
  {
    this->Impl->StartAnew();
  }
  this->Impl->Sweep.RequestSteps(this, request, inputs, outputs,
                                 this->Impl->Cache.IsCurrent(this, inputs));
  return 1;
}

int vtkTrajectoryTraceFilter::RequestData(vtkInformation* request, vtkInformationVector** inputs,
                                          vtkInformationVector* outputs)
{
  Internals& impl = *this->Impl;
  if (!impl.Cache.IsCurrent(this, inputs))
  {
    impl.SinceBegin();
    if (waft::HasUnfinishedInput(this, inputs))
    {
      impl.Sweep.Reset(request);
      return impl.Leave(Internals::Work::Waits, outputs);
    }
    auto options = waft::OptionsOf<waft::TraceOptions>(*this);
    waft::CopyFields<waft::AnnotationOptions>(*this, options.Annotation);
    const bool isFirst = impl.Sweep.IsFirst();
    waft::Result result = isFirst ? impl.Begin(this, inputs, options) : waft::Result::Ok();
    result = result && impl.Sweep.HasNewStep() ? impl.Feed(inputs, isFirst) : result;
    if (!result)
    {
      impl.Sweep.Reset(request);
      return waft::Fail(this, outputs, result.Message());
    }
    waft::StageMonitor monitor(this);
    const bool goesOn = monitor.Tick(impl.Sweep.Fraction(), Doing);
    const double passed = impl.SinceBegin();
    const bool isOver = this->Slice > 0.0 && passed >= this->Slice;
    if (goesOn && (isOver ? impl.Sweep.Pause(request) : impl.Sweep.Continue(request)))
    {
      if (!isOver)
      {
        return 1;
      }
      monitor.Hold();
      impl.Worked += passed;
      impl.Paused.MarkCurrent(this, inputs);
      return impl.Leave(Internals::Work::Paused, outputs);
    }
    impl.StartAnew();
    impl.Sweep.Reset(request);
    result = goesOn ? impl.FeedSteady(inputs) : waft::Result::Ok();
    if (!result)
    {
      return waft::Fail(this, outputs, result.Message());
    }
    waft::TracksToPolyData(impl.Tracer.Finish(), impl.Info, impl.Tracks);
    waft::AddDoubles(impl.Tracks->GetFieldData(), waft::names::SettlingSpeed,
                     { this->SettlingSpeed });
    impl.Cache.Forget();
    if (goesOn)
    {
      impl.Cache.MarkCurrent(this, inputs);
    }
  }
  vtkPolyData::GetData(outputs)->ShallowCopy(impl.Tracks);
  waft::RequestedTime(outputs, 0, impl.Info.Time);
  return 1;
}

void vtkTrajectoryTraceFilter::SetSlice(double seconds)
{
  this->Slice = std::clamp(seconds, 0.0, 1e+09);
}

void vtkTrajectoryTraceFilter::WorkInSlices()
{
  this->SetSlice(0.5);
}

void vtkTrajectoryTraceFilter::GoOn()
{
  Internals& impl = *this->Impl;
  if (impl.Now == Internals::Work::Paused || impl.Now == Internals::Work::Held)
  {
    impl.Now = Internals::Work::Paused;
    impl.Paused.Reawaken(this);
  }
}

void vtkTrajectoryTraceFilter::Hold()
{
  Internals& impl = *this->Impl;
  impl.Now = impl.Now == Internals::Work::Paused ? Internals::Work::Held : impl.Now;
}

void vtkTrajectoryTraceFilter::LetGo()
{
  this->GetOutput()->Initialize();
  this->Impl->StartAnew();
  this->Impl->Tracks->Initialize();
  this->Impl->Cache.Forget();
  this->Modified();
}

int vtkTrajectoryTraceFilter::GetComplete()
{
  return waft::HasFailed(this) || !this->Impl->IsUnfinished() ? 1 : 0;
}

int vtkTrajectoryTraceFilter::GetWorkState()
{
  return this->Impl->Now == Internals::Work::Paused ? ARRIVED
         : this->Impl->Now == Internals::Work::Held ? HELD
                                                    : NO_WORK;
}

double vtkTrajectoryTraceFilter::GetWorkDone()
{
  return this->Impl->IsUnfinished() ? this->Impl->Sweep.Fraction() : 1.0;
}

std::string vtkTrajectoryTraceFilter::GetWorkText()
{
  const char* text = this->Impl->IsUnfinished() ? Doing : this->GetProgressText();
  return text != nullptr ? text : "";
}

double vtkTrajectoryTraceFilter::GetSecondsLeft()
{
  const double done = this->GetWorkDone();
  return done > 0.0 ? this->Impl->Worked * (1.0 - done) / done : -1.0;
}

void vtkTrajectoryTraceFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::TraceOptions, waft::AnnotationOptions, waft::SliceOptions>(os, indent,
                                                                                     *this);
}
