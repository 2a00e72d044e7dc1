// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGridSmokeSource.h"

#include "Bridge/FieldCollectors.h"
#include "Bridge/FieldSweep.h"
#include "Bridge/SmokeData.h"
#include "Bridge/StageExecution.h"
#include "Bridge/VortexData.h"
#include "Grid/SmokeEnsemble.h"
#include "Grid/SmokeSeries.h"

#include <vtkDemandDrivenPipeline.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <cmath>

vtkStandardNewMacro(vtkGridSmokeSource);

namespace
{

enum InputPort
{
  NothingIn,
  ObstaclesIn,
  WindIn,
  VorticesIn,
  NumberOfInputs
};

enum OutputPort
{
  SmokeOut,
  VorticesOut,
  ObstaclesOut,
  NumberOfOutputs
};

constexpr std::size_t Megabyte = std::size_t(1) << 20;

waft::Range RangeOf(const double* range)
{
  return waft::Range{ range[0], range[1] };
}

template <typename Data>
Data* Input(vtkInformationVector** inputs, int port)
{
  return inputs[port]->GetNumberOfInformationObjects() > 0 ? Data::GetData(inputs[port]) : nullptr;
}

} // namespace

struct vtkGridSmokeSource::Internals
{
  waft::StageCache Cache;
  waft::FieldSweep Fields{ ObstaclesIn, WindIn };
  waft::SceneInfo Info;
  std::vector<waft::Vortex> Vortices;
  std::vector<waft::ObstacleMesh> Obstacles;
  waft::SmokeSeries Series;

  waft::SceneInfo SceneOf(const vtkGridSmokeSource& self) const;
  waft::SmokeOptions OptionsOf(const vtkGridSmokeSource& self) const;
  waft::EnsembleOptions EnsembleOf(const vtkGridSmokeSource& self) const;
  waft::Result Begin(const vtkGridSmokeSource& self, vtkInformationVector** inputs);
  /// Fills the outputs; frame becomes an earlier one when the stage was stopped.
  waft::Result Show(vtkGridSmokeSource& self, int& frame, vtkInformationVector* outputs);
};

waft::SceneInfo vtkGridSmokeSource::Internals::SceneOf(const vtkGridSmokeSource& self) const
{
  waft::SceneInfo info;
  const double* b = self.Bounds;
  info.Bounds = waft::Box{ waft::Vec3(b[0], b[2], b[4]), waft::Vec3(b[1], b[3], b[5]) };
  info.Time = waft::Timeline{ self.NumberOfFrames, self.FramesPerSecond };
  info.AirDensity = self.AirDensity;
  info.Seed = static_cast<std::uint64_t>(self.Seed);
  return info;
}

waft::SmokeOptions vtkGridSmokeSource::Internals::OptionsOf(const vtkGridSmokeSource& self) const
{
  waft::SmokeOptions options;
  options.Bounds = this->Info.Bounds;
  std::copy(self.Resolution, self.Resolution + 3, options.Resolution.begin());
  options.FramesPerSecond = self.FramesPerSecond;
  options.WarmUpSeconds = self.WarmUpSeconds;
  options.Advection = static_cast<waft::AdvectionScheme>(self.Advection);
  options.Boundary = { static_cast<waft::BoundaryKind>(self.BoundaryX),
                       static_cast<waft::BoundaryKind>(self.BoundaryY),
                       static_cast<waft::BoundaryKind>(self.BoundaryZ) };
  options.ClosedFloor = self.ClosedFloor;
  options.Confinement = self.Confinement;
  options.BuoyancyDensity = self.BuoyancyDensity;
  options.BuoyancyTemperature = self.BuoyancyTemperature;
  options.Dissipation = self.Dissipation;
  options.WindDrag = self.WindDrag;
  options.CourantNumber = self.CourantNumber;
  options.Tolerance = self.Tolerance;
  options.AirDensity = self.AirDensity;
  return options;
}

waft::EnsembleOptions vtkGridSmokeSource::Internals::EnsembleOf(
  const vtkGridSmokeSource& self) const
{
  waft::EnsembleOptions options;
  options.Seed = this->Info.Seed;
  options.Bounds = this->Info.Bounds;
  options.Time = this->Info.Time;
  options.WarmUpSeconds = self.WarmUpSeconds;
  options.NumberOfVortices = self.NumberOfVortices;
  options.NumberOfWinds = self.NumberOfWinds;
  options.NumberOfObstacles = self.NumberOfObstacles;
  options.NumberOfEmitters = self.NumberOfEmitters;
  options.VortexDiameter = RangeOf(self.VortexDiameter);
  options.VortexLength = RangeOf(self.VortexLength);
  options.VortexAcceleration = RangeOf(self.VortexAcceleration);
  options.VortexDuration = RangeOf(self.VortexDuration);
  options.WindRadius = RangeOf(self.WindRadius);
  options.WindAcceleration = RangeOf(self.WindAcceleration);
  options.WindDuration = RangeOf(self.WindDuration);
  options.ObstacleSize = RangeOf(self.ObstacleSize);
  return options;
}

waft::Result vtkGridSmokeSource::Internals::Begin(const vtkGridSmokeSource& self,
                                                  vtkInformationVector** inputs)
{
  const waft::SmokeOptions options = this->OptionsOf(self);
  WAFT_RETURN_IF_FAILED(options.Validate());
  waft::Ensemble random;
  WAFT_RETURN_IF_FAILED(waft::MakeEnsemble(this->EnsembleOf(self), random));
  for (waft::SmokeEmitter& emitter : random.Forces.Emitters)
  {
    emitter.Temperature = self.EmitterTemperature;
  }

  // What comes in keeps its ids; what is random is numbered after it.
  this->Vortices.clear();
  if (auto* lines = Input<vtkPolyData>(inputs, VorticesIn))
  {
    WAFT_RETURN_IF_FAILED(waft::VorticesFromPolyData(lines, this->Vortices));
  }
  int vortexId = 0;
  for (const waft::Vortex& vortex : this->Vortices)
  {
    vortexId = std::max(vortexId, vortex.VortexId + 1);
  }
  for (waft::Vortex& vortex : random.Forces.Vortices)
  {
    vortex.VortexId = vortexId++;
    this->Vortices.push_back(vortex);
  }
  this->Obstacles = this->Fields.TakeObstacles();
  int obstacleId = 0;
  for (const waft::ObstacleMesh& obstacle : this->Obstacles)
  {
    obstacleId = std::max(obstacleId, obstacle.ObstacleId + 1);
  }
  for (waft::ObstacleMesh& obstacle : random.Obstacles)
  {
    obstacle.ObstacleId = obstacleId++;
    this->Obstacles.push_back(std::move(obstacle));
  }

  waft::SmokeSeriesInput input;
  input.Options = options;
  input.Forces = std::move(random.Forces);
  input.Forces.Vortices = this->Vortices;
  input.Forces.Wind = this->Fields.TakeWind();
  input.NumberOfFrames = this->Info.Time.NumberOfFrames;
  input.CacheLimit = static_cast<std::size_t>(self.CacheLimit) * Megabyte;
  if (!this->Obstacles.empty())
  {
    input.Solids =
      [obstacles = this->Obstacles, options](int frame, auto& distances, auto& velocities)
    { return waft::NodeDistances(obstacles, frame, options, distances, velocities); };
    input.SolidsMove = std::any_of(this->Obstacles.begin(), this->Obstacles.end(),
                                   [](const waft::ObstacleMesh& o) { return o.IsMoving(); });
  }
  return this->Series.Begin(std::move(input));
}

waft::Result vtkGridSmokeSource::Internals::Show(vtkGridSmokeSource& self, int& frame,
                                                 vtkInformationVector* outputs)
{
  waft::StageMonitor monitor(&self);
  std::shared_ptr<const waft::SmokeFrame> fields;
  WAFT_RETURN_IF_FAILED(this->Series.At(frame, waft::SmpFor(), monitor, fields));
  if (fields)
  {
    frame = fields->Frame;
    waft::SmokeFrameToImage(*fields, this->Info, vtkImageData::GetData(outputs, SmokeOut));
  }
  waft::VorticesToPolyData(this->Vortices, this->Info, vtkPolyData::GetData(outputs, VorticesOut));
  waft::ObstaclesToPolyData(this->Obstacles, frame, this->Info,
                            vtkPolyData::GetData(outputs, ObstaclesOut));
  return waft::Result::Ok();
}

vtkGridSmokeSource::vtkGridSmokeSource() : Impl(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(NumberOfInputs);
  this->SetNumberOfOutputPorts(NumberOfOutputs);
}

vtkGridSmokeSource::~vtkGridSmokeSource() = default;

double vtkGridSmokeSource::GetCacheSize() const
{
  return static_cast<double>(this->Impl->Series.BytesKept()) / static_cast<double>(Megabyte);
}

int vtkGridSmokeSource::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == WindIn      ? "vtkImageData"
                                                      : port == NothingIn ? "vtkDataObject"
                                                                          : "vtkPolyData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

int vtkGridSmokeSource::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == SmokeOut ? "vtkImageData" : "vtkPolyData");
  return 1;
}

vtkTypeBool vtkGridSmokeSource::ProcessRequest(vtkInformation* request,
                                               vtkInformationVector** inputs,
                                               vtkInformationVector* outputs)
{
  return waft::GuardedRequest(
    this, request, outputs,
    { { "Resolution", this->Resolution, waft::limits::Range{ 1, 4096 } },
      { "Bounds", this->Bounds, waft::limits::Coordinate },
      { "NumberOfFrames", this->NumberOfFrames,
        waft::limits::Range{ 1, waft::limits::Frames.High } },
      { "FramesPerSecond", this->FramesPerSecond, waft::limits::FramesPerSecond },
      { "AirDensity", this->AirDensity, waft::limits::Density },
      { "WarmUpSeconds", this->WarmUpSeconds, waft::limits::UpTo(1e6) },
      { "Confinement", this->Confinement, waft::limits::Around0(1e9) },
      { "BuoyancyDensity", this->BuoyancyDensity, waft::limits::Around0(1e9) },
      { "BuoyancyTemperature", this->BuoyancyTemperature, waft::limits::Around0(1e9) },
      { "EmitterTemperature", this->EmitterTemperature, waft::limits::Around0(1e9) },
      { "Dissipation", this->Dissipation, waft::limits::Around0(1e9) },
      { "WindDrag", this->WindDrag, waft::limits::Around0(1e9) },
      { "CourantNumber", this->CourantNumber, waft::limits::Around0(1e9) },
      { "Tolerance", this->Tolerance, waft::limits::Around0(1e9) },
      { "NumberOfVortices", this->NumberOfVortices, waft::limits::UpTo(1e4) },
      { "NumberOfWinds", this->NumberOfWinds, waft::limits::UpTo(1e4) },
      { "NumberOfObstacles", this->NumberOfObstacles, waft::limits::UpTo(1e4) },
      { "VortexDiameter", this->VortexDiameter, waft::limits::Distance },
      { "VortexLength", this->VortexLength, waft::limits::Distance },
      { "VortexAcceleration", this->VortexAcceleration, waft::limits::Around0(1e9) },
      { "VortexDuration", this->VortexDuration, waft::limits::UpTo(1e9) },
      { "WindRadius", this->WindRadius, waft::limits::Distance },
      { "WindAcceleration", this->WindAcceleration, waft::limits::Around0(1e9) },
      { "WindDuration", this->WindDuration, waft::limits::UpTo(1e9) },
      { "ObstacleSize", this->ObstacleSize, waft::limits::Distance } },
    [&] { return this->Process(request, inputs, outputs); });
}

int vtkGridSmokeSource::Process(vtkInformation* request, vtkInformationVector** inputs,
                                vtkInformationVector* outputs)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_INFORMATION()))
  {
    return this->RequestInformation(outputs);
  }
  if (request->Has(vtkStreamingDemandDrivenPipeline::REQUEST_UPDATE_EXTENT()))
  {
    this->Impl->Fields.RequestSteps(this, request, inputs, outputs,
                                    this->Impl->Cache.IsCurrent(this, inputs));
    return 1;
  }
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    return this->RequestData(request, inputs, outputs);
  }
  return this->Superclass::ProcessRequest(request, inputs, outputs);
}

int vtkGridSmokeSource::RequestInformation(vtkInformationVector* outputs)
{
  const int* n = this->Resolution;
  const int extent[6] = { 0, n[0] - 1, 0, n[1] - 1, 0, n[2] - 1 };
  outputs->GetInformationObject(SmokeOut)->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(),
                                               extent, 6);
  if (this->FramesPerSecond > 0.0)
  {
    waft::SetTimeSteps(waft::Timeline{ this->NumberOfFrames, this->FramesPerSecond }, outputs);
  }
  return 1;
}

int vtkGridSmokeSource::RequestData(vtkInformation* request, vtkInformationVector** inputs,
                                    vtkInformationVector* outputs)
{
  Internals& impl = *this->Impl;
  if (!impl.Cache.IsCurrent(this, inputs))
  {
    impl.Info = impl.SceneOf(*this);
    waft::Result result = impl.Fields.Take(inputs, impl.Info.Time);
    if (result && impl.Fields.Continue(request))
    {
      return 1;
    }
    result = result ? impl.Begin(*this, inputs) : result;
    if (!result)
    {
      impl.Fields.Reset(request);
      impl.Cache.Forget();
      return waft::Fail(this, outputs, result.Message());
    }
    impl.Cache.MarkCurrent(this, inputs);
  }
  const double time = waft::RequestedTimeOfAll(request, outputs, impl.Info.Time);
  int frame = static_cast<int>(std::lround(time * impl.Info.Time.FramesPerSecond));
  const waft::Result shown = impl.Show(*this, frame, outputs);
  if (!shown)
  {
    impl.Cache.Forget();
    return waft::Fail(this, outputs, shown.Message());
  }
  for (int port = 0; port < NumberOfOutputs; ++port)
  {
    vtkDataObject::GetData(outputs, port)
      ->GetInformation()
      ->Set(vtkDataObject::DATA_TIME_STEP(), impl.Info.Time.Time(frame));
  }
  return 1;
}

void vtkGridSmokeSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto range = [&os, indent](const char* name, const double* values)
  { os << indent << name << ": " << values[0] << " " << values[1] << "\n"; };
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "Resolution: " << this->Resolution[0] << " " << this->Resolution[1] << " "
     << this->Resolution[2] << "\n";
  os << indent << "Bounds:";
  for (const double bound : this->Bounds)
  {
    os << " " << bound;
  }
  os << "\n";
  os << indent << "NumberOfFrames: " << this->NumberOfFrames << "\n";
  os << indent << "FramesPerSecond: " << this->FramesPerSecond << "\n";
  os << indent << "AirDensity: " << this->AirDensity << "\n";
  os << indent << "WarmUpSeconds: " << this->WarmUpSeconds << "\n";
  os << indent << "Advection: " << this->Advection << "\n";
  os << indent << "BoundaryX: " << this->BoundaryX << "\n";
  os << indent << "BoundaryY: " << this->BoundaryY << "\n";
  os << indent << "BoundaryZ: " << this->BoundaryZ << "\n";
  os << indent << "ClosedFloor: " << this->ClosedFloor << "\n";
  os << indent << "Confinement: " << this->Confinement << "\n";
  os << indent << "BuoyancyDensity: " << this->BuoyancyDensity << "\n";
  os << indent << "BuoyancyTemperature: " << this->BuoyancyTemperature << "\n";
  os << indent << "EmitterTemperature: " << this->EmitterTemperature << "\n";
  os << indent << "Dissipation: " << this->Dissipation << "\n";
  os << indent << "WindDrag: " << this->WindDrag << "\n";
  os << indent << "CourantNumber: " << this->CourantNumber << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "NumberOfVortices: " << this->NumberOfVortices << "\n";
  os << indent << "NumberOfWinds: " << this->NumberOfWinds << "\n";
  os << indent << "NumberOfObstacles: " << this->NumberOfObstacles << "\n";
  os << indent << "NumberOfEmitters: " << this->NumberOfEmitters << "\n";
  range("VortexDiameter", this->VortexDiameter);
  range("VortexLength", this->VortexLength);
  range("VortexAcceleration", this->VortexAcceleration);
  range("VortexDuration", this->VortexDuration);
  range("WindRadius", this->WindRadius);
  range("WindAcceleration", this->WindAcceleration);
  range("WindDuration", this->WindDuration);
  range("ObstacleSize", this->ObstacleSize);
  os << indent << "CacheLimit: " << this->CacheLimit << "\n";
}
