// SPDX-License-Identifier: BSD-3-Clause
#include "vtkGridSmokeSource.h"

#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/SmokeData.h"
#include "Bridge/Data/VortexData.h"
#include "Bridge/Pipeline/FieldSweep.h"
#include "Bridge/Pipeline/SlicedStage.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageInputs.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Grid/NodeSolids.h"
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

template <typename Data>
Data* Input(vtkInformationVector** inputs, int port)
{
  return inputs[port]->GetNumberOfInformationObjects() > 0 ? Data::GetData(inputs[port]) : nullptr;
}

using waft::StageInput;

const waft::StageInputs InputsOfSmoke = {
  { "Input", StageInput::Type::Anything, StageInput::Number::Optional },
  { "Obstacles", StageInput::Type::Surfaces, StageInput::Number::Optional },
  { "Wind", StageInput::Type::Image, StageInput::Number::Optional },
  { "Vortices", StageInput::Type::Merged, StageInput::Number::Optional },
};

} // namespace

/// The work is the first frame that is asked for: the air before it takes the most. The others are
/// computed when they are asked for.
struct vtkGridSmokeSource::Internals : waft::KeptStage
{
  vtkGridSmokeSource* Self;
  std::vector<waft::Vortex> Vortices;
  std::vector<waft::ObstacleMesh> Obstacles;
  waft::SmokeSeries Series;
  int First = 0; // frame

  explicit Internals(vtkGridSmokeSource* self) :
    KeptStage(self, waft::FieldSweep::NoPort, ObstaclesIn, WindIn), Self(self)
  {
  }
  ~Internals() override { this->Discard(); }
  double Slice() const override { return this->Self->Slice; }
  void Clear() override { this->Series = waft::SmokeSeries(); }
  void TakeScene(vtkInformation* request, vtkInformationVector* outputs);
  waft::Result Begin(vtkInformationVector** inputs);
  waft::Result Run(vtkInformationVector** inputs, waft::Monitor& monitor) override;
  waft::Result ShowFrame(vtkInformationVector* outputs);
};

void vtkGridSmokeSource::Internals::TakeScene(vtkInformation* request,
                                              vtkInformationVector* outputs)
{
  const double* b = this->Self->Bounds;
  this->Scene.Bounds = waft::Box{ waft::Vec3(b[0], b[2], b[4]), waft::Vec3(b[1], b[3], b[5]) };
  this->Scene.Time = waft::Timeline{ this->Self->NumberOfFrames, this->Self->FramesPerSecond };
  this->Scene.AirDensity = this->Self->AirDensity;
  this->Scene.Seed = static_cast<std::uint64_t>(this->Self->Seed);
  this->First = this->FrameAt(waft::RequestedTimeOfAll(request, outputs, this->Scene.Time));
}

waft::Result vtkGridSmokeSource::Internals::Begin(vtkInformationVector** inputs)
{
  const vtkGridSmokeSource& self = *this->Self;
  const auto options = waft::OptionsOf<waft::SmokeOptions>(self);
  WAFT_RETURN_IF_FAILED(options.Validate());
  auto scene = waft::OptionsOf<waft::EnsembleOptions>(self);
  waft::CopyFields<waft::AirRun>(options, scene);
  waft::Ensemble random;
  WAFT_RETURN_IF_FAILED(waft::MakeEnsemble(scene, random));

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
  input.NumberOfFrames = this->Scene.Time.NumberOfFrames;
  input.CacheLimit = static_cast<std::size_t>(self.CacheLimit) * Megabyte;
  if (!this->Obstacles.empty())
  {
    input.Solids = waft::NodeSolids(this->Obstacles, options);
    input.SolidsMove = std::any_of(this->Obstacles.begin(), this->Obstacles.end(),
                                   [](const waft::ObstacleMesh& o) { return o.IsMoving(); });
  }
  return this->Series.Begin(std::move(input));
}

waft::Result vtkGridSmokeSource::Internals::Run(vtkInformationVector** inputs,
                                                waft::Monitor& monitor)
{
  const int first = this->First;
  WAFT_RETURN_IF_FAILED(this->Begin(inputs));
  std::shared_ptr<const waft::SmokeFrame> fields;
  return this->Slice() > 0.0 ? this->Series.At(first, waft::SmpFor(), monitor, fields)
                             : waft::Result::Ok();
}

waft::Result vtkGridSmokeSource::Internals::ShowFrame(vtkInformationVector* outputs)
{
  int frame = this->First;
  waft::StageMonitor monitor(this->Self);
  std::shared_ptr<const waft::SmokeFrame> fields;
  WAFT_RETURN_IF_FAILED(this->Series.At(frame, waft::SmpFor(), monitor, fields));
  if (fields)
  {
    frame = fields->Frame; // an earlier one where the stage was stopped
    waft::SmokeFrameToImage(*fields, this->Scene, vtkImageData::GetData(outputs, SmokeOut));
  }
  waft::VorticesToPolyData(this->Vortices, this->Scene, vtkPolyData::GetData(outputs, VorticesOut));
  waft::ObstaclesToPolyData(this->Obstacles, frame, this->Scene,
                            vtkPolyData::GetData(outputs, ObstaclesOut));
  for (int port = 0; port < NumberOfOutputs; ++port)
  {
    vtkDataObject::GetData(outputs, port)
      ->GetInformation()
      ->Set(vtkDataObject::DATA_TIME_STEP(), this->Scene.Time.Time(frame));
  }
  return waft::Result::Ok();
}

vtkGridSmokeSource::vtkGridSmokeSource() : Impl(std::make_unique<Internals>(this))
{
  waft::TakeDefaults<waft::SmokeOptions, waft::EnsembleOptions>(*this);
  this->SetNumberOfInputPorts(NumberOfInputs);
  this->SetNumberOfOutputPorts(NumberOfOutputs);
}

vtkGridSmokeSource::~vtkGridSmokeSource() = default;

double vtkGridSmokeSource::InRange(const char* property, double value)
{
  return waft::InRange<waft::SmokeOptions, waft::EnsembleOptions>(property, value);
}

double vtkGridSmokeSource::GetCacheSize() const
{
  return static_cast<double>(this->Impl->Series.BytesKept()) / static_cast<double>(Megabyte);
}

int vtkGridSmokeSource::FillInputPortInformation(int port, vtkInformation* info)
{
  return waft::FillInput(InputsOfSmoke, port, info);
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
    this, request, inputs, outputs, InputsOfSmoke,
    waft::RangesOf<waft::SmokeOptions, waft::EnsembleOptions, waft::SliceOptions>(*this),
    [&](vtkInformationVector** taken) { return this->Process(request, taken, outputs); });
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
    return this->Impl->RequestUpdateExtent(request, inputs, outputs);
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
  impl.TakeScene(request, outputs);
  impl.RequestData(request, inputs, outputs);
  const bool goesOn = request->Has(vtkStreamingDemandDrivenPipeline::CONTINUE_EXECUTING()) != 0;
  if (goesOn || waft::HasFailed(this) || !impl.IsComplete())
  {
    return 1;
  }
  const waft::Result shown = impl.ShowFrame(outputs);
  if (!shown)
  {
    impl.LetGo();
    return waft::Fail(this, outputs, shown.Message());
  }
  return 1;
}

waft::KeptStage& vtkGridSmokeSource::Kept()
{
  return *this->Impl;
}

WaftSlicesOf(vtkGridSmokeSource);

void vtkGridSmokeSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::SmokeOptions, waft::EnsembleOptions, waft::SliceOptions>(os, indent,
                                                                                   *this);
  os << indent << "CacheLimit: " << this->CacheLimit << "\n";
}
