// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSPHSpacetimeFilter.h"

#include "Bridge/ArrayNames.h"
#include "Bridge/Arrays.h"
#include "Bridge/ConstraintData.h"
#include "Bridge/FieldCollectors.h"
#include "Bridge/KeptStage.h"
#include "Bridge/Ranks.h"
#include "Bridge/SceneData.h"
#include "Bridge/SpacetimeData.h"
#include "Bridge/StageExecution.h"
#include "Bridge/TrackData.h"
#include "Bridge/VortexData.h"
#include "Spacetime/Spacetime.h"
#include "Spacetime/SpacetimeBudget.h"
#include "Spacetime/SpacetimeMemory.h"

#include <vtkCellData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiProcessController.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTable.h>

vtkStandardNewMacro(vtkSPHSpacetimeFilter);

namespace
{

enum InputPort
{
  PlannedPort,
  ObjectsPort,
  ConstraintsPort,
  ObstaclesPort,
  GuessedVorticesPort,
  BackgroundPort,
  NumberOfInputs
};

enum OutputPort
{
  TracksPort,
  ParticlesPort,
  VorticesPort,
  WindPort,
  ConvergencePort,
  ReportPort,
  NumberOfOutputs
};

} // namespace

struct vtkSPHSpacetimeFilter::Internals : waft::KeptStage
{
  vtkSPHSpacetimeFilter* Self;
  waft::SpacetimeOutput Solution;
  waft::SpacetimeMemory Memory; // of the last run, for the next

  explicit Internals(vtkSPHSpacetimeFilter* self) :
    KeptStage(self, PlannedPort, ObstaclesPort, BackgroundPort), Self(self)
  {
  }
  waft::SpacetimeOptions Options() const;
  waft::Result Take(vtkInformationVector** inputs, waft::SpacetimeInput& input);
  waft::Result Run(vtkInformationVector** inputs, waft::Monitor& monitor) override;
  waft::Result Agree(const waft::Result& own) override;
  bool RunsOnAllRanks() const override { return true; }
  void KeepSolution();
  void FillVarying(double time, vtkInformationVector* outputs) const override;
};

waft::SpacetimeOptions vtkSPHSpacetimeFilter::Internals::Options() const
{
  waft::SpacetimeOptions options;
  options.NumberOfGasParticles = this->Self->NumberOfGasParticles;
  options.NumberOfObjectParticles = this->Self->NumberOfObjectParticles;
  options.PositionWeight = this->Self->PositionWeight;
  options.VelocityWeight = this->Self->VelocityWeight;
  options.CoherenceWeight = this->Self->CoherenceWeight;
  options.SpatialShare = this->Self->SpatialShare;
  options.ObjectCoherence = this->Self->ObjectCoherence;
  options.ObjectPosition = this->Self->ObjectPosition;
  options.TemporalWindow = this->Self->TemporalWindow;
  options.SmoothingLength = this->Self->SmoothingLength;
  options.CourantNumber = this->Self->CourantNumber;
  options.Viscosity = this->Self->Viscosity;
  options.XsphFactor = this->Self->XsphFactor;
  options.PressureExponent = this->Self->PressureExponent;
  options.EffectiveGravity = this->Self->EffectiveGravity;
  options.ContactDistance = this->Self->ContactDistance;
  options.WindDrag = this->Self->WindDrag;
  options.EstimateWind = this->Self->EstimateWind;
  options.FitVortexFields = this->Self->FitVortexFields;
  options.MaximumNumberOfVortices = this->Self->MaximumNumberOfVortices;
  options.Passes = this->Self->Passes;
  options.UseLeash = this->Self->UseLeash;
  options.LeashIterations = this->Self->LeashIterations;
  options.MaximumNumberOfIterations = this->Self->MaximumNumberOfIterations;
  options.Tolerance = this->Self->Tolerance;
  options.TimeLimit = this->Self->TimeLimit;
  options.HistorySize = this->Self->HistorySize;
  options.WarmStart = this->Self->WarmStart;
  options.EditDuration = this->Self->EditDuration;
  options.EditRadius = this->Self->EditRadius;
  options.MemoryLimit = this->Self->MemoryLimit;
  options.CheckpointFile = this->Self->CheckpointFile;
  options.CheckpointInterval = this->Self->CheckpointInterval;
  return options;
}

waft::Result vtkSPHSpacetimeFilter::Internals::Take(vtkInformationVector** inputs,
                                                    waft::SpacetimeInput& input)
{
  input.Scene = this->Scene;
  WAFT_RETURN_IF_FAILED(
    waft::TracksFromPolyData(vtkPolyData::GetData(inputs[PlannedPort]), input.Tracks));
  WAFT_RETURN_IF_FAILED(
    waft::ObjectsFromPolyData(vtkPolyData::GetData(inputs[ObjectsPort]), input.Objects));
  WAFT_RETURN_IF_FAILED(this->TakeConstraints(inputs[ConstraintsPort], input.Constraints));
  if (vtkPolyData* vortices = vtkPolyData::GetData(inputs[GuessedVorticesPort]))
  {
    WAFT_RETURN_IF_FAILED(waft::VorticesFromPolyData(vortices, input.Vortices));
  }
  input.Obstacles = this->Fields.TakeObstacles();
  input.Wind = this->Fields.TakeWind();
  return input.Wind.Validate("Wind");
}

// Inputs may have come to the first rank alone.
waft::Result vtkSPHSpacetimeFilter::Internals::Agree(const waft::Result& own)
{
  waft::ControllerCommunicator ranks(this->Self->Controller);
  return ranks.Size() > 1 ? waft::ResultOfFirst(ranks, own) : own;
}

waft::Result vtkSPHSpacetimeFilter::Internals::Run(vtkInformationVector** inputs,
                                                   waft::Monitor& monitor)
{
  waft::ControllerCommunicator ranks(this->Self->Controller);
  this->Solution = waft::SpacetimeOutput();
  waft::SpacetimeInput input;
  const waft::Result taken = this->Take(inputs, input);
  WAFT_RETURN_IF_FAILED(this->Agree(taken));
  WAFT_RETURN_IF_FAILED(waft::RunSpacetime(input, this->Options(), waft::SmpFor(), monitor,
                                           this->Solution, &this->Memory, &ranks));
  this->Warnings = this->Solution.Warnings;
  if (ranks.IsFirst())
  {
    this->KeepSolution();
  }
  return waft::Result::Ok(); // also when stopped: the best so far is shown until something changes
}

void vtkSPHSpacetimeFilter::Internals::KeepSolution()
{
  auto* tracks = this->Kept<vtkPolyData>(TracksPort);
  waft::TracksToPolyData(this->Solution.Tracks, this->Scene, tracks);
  waft::AddDoubles(tracks->GetCellData(), waft::names::PositionResidual,
                   this->Solution.PositionResiduals);
  waft::AddDoubles(tracks->GetCellData(), waft::names::VelocityResidual,
                   this->Solution.VelocityResiduals);
  waft::VorticesToPolyData(this->Solution.Vortices, this->Scene,
                           this->Kept<vtkPolyData>(VorticesPort));
  waft::ConvergenceToTable(this->Solution.Convergence, this->Scene,
                           this->Kept<vtkTable>(ConvergencePort));
  waft::ReportToTable(this->Solution.Report, this->Scene, this->Kept<vtkTable>(ReportPort));
}

void vtkSPHSpacetimeFilter::Internals::FillVarying(double time, vtkInformationVector* outputs) const
{
  if (this->Solution.Particles.Frames.empty())
  {
    return; // the result is with the first rank
  }
  waft::ParticlesToPolyData(this->Solution.Particles, this->FrameAt(time), this->Scene,
                            vtkPolyData::GetData(outputs, ParticlesPort));
  waft::FieldSeriesToImage(this->Solution.Wind, time, this->Scene,
                           vtkImageData::GetData(outputs, WindPort));
}

vtkSPHSpacetimeFilter::vtkSPHSpacetimeFilter() : Impl(std::make_unique<Internals>(this))
{
  this->SetNumberOfInputPorts(NumberOfInputs);
  this->SetNumberOfOutputPorts(NumberOfOutputs);
  this->Controller = vtkMultiProcessController::GetGlobalController();
}

vtkSPHSpacetimeFilter::~vtkSPHSpacetimeFilter() = default;

void vtkSPHSpacetimeFilter::SetController(vtkMultiProcessController* controller)
{
  if (this->Controller != controller)
  {
    this->Controller = controller;
    this->Modified();
  }
}

vtkMultiProcessController* vtkSPHSpacetimeFilter::GetController()
{
  return this->Controller;
}

void vtkSPHSpacetimeFilter::Continue()
{
  this->Modified();
}

void vtkSPHSpacetimeFilter::Restart()
{
  this->Impl->Memory = waft::SpacetimeMemory();
  this->Modified();
}

int vtkSPHSpacetimeFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(),
            port == BackgroundPort ? "vtkImageData" : "vtkPolyData");
  if (port >= ObstaclesPort)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkSPHSpacetimeFilter::FillOutputPortInformation(int port, vtkInformation* info)
{
  const bool isTable = port == ConvergencePort || port == ReportPort;
  info->Set(vtkDataObject::DATA_TYPE_NAME(), isTable            ? "vtkTable"
                                             : port == WindPort ? "vtkImageData"
                                                                : "vtkPolyData");
  return 1;
}

std::string vtkSPHSpacetimeFilter::CheckRoom(const double bounds[6], int numberOfFrames,
                                             int numberOfObjects) const
{
  const waft::Box volume{ waft::Vec3(bounds[0], bounds[2], bounds[4]),
                          waft::Vec3(bounds[1], bounds[3], bounds[5]) };
  return waft::CheckRoom(volume, numberOfFrames,
                         static_cast<std::size_t>(std::max(0, numberOfObjects)),
                         this->Impl->Options())
    .Message();
}

vtkTypeBool vtkSPHSpacetimeFilter::ProcessRequest(vtkInformation* request,
                                                  vtkInformationVector** inputs,
                                                  vtkInformationVector* outputs)
{
  return waft::GuardedRequest(
    this, request, outputs,
    { { "PositionWeight", this->PositionWeight, waft::limits::Finite },
      { "VelocityWeight", this->VelocityWeight, waft::limits::Finite },
      { "CoherenceWeight", this->CoherenceWeight, waft::limits::Finite },
      { "SpatialShare", this->SpatialShare, waft::limits::Finite },
      { "ObjectCoherence", this->ObjectCoherence, waft::limits::Finite },
      { "ObjectPosition", this->ObjectPosition, waft::limits::Finite },
      { "SmoothingLength", this->SmoothingLength, waft::limits::Finite },
      { "CourantNumber", this->CourantNumber, waft::limits::Finite },
      { "Viscosity", this->Viscosity, waft::limits::Finite },
      { "XsphFactor", this->XsphFactor, waft::limits::Finite },
      { "PressureExponent", this->PressureExponent, waft::limits::Finite },
      { "EffectiveGravity", this->EffectiveGravity, waft::limits::Finite },
      { "ContactDistance", this->ContactDistance, waft::limits::Finite },
      { "WindDrag", this->WindDrag, waft::limits::Finite },
      { "Tolerance", this->Tolerance, waft::limits::Finite },
      { "TimeLimit", this->TimeLimit, waft::limits::Finite },
      { "EditDuration", this->EditDuration, waft::limits::Finite },
      { "EditRadius", this->EditRadius, waft::limits::Finite },
      { "MemoryLimit", this->MemoryLimit, waft::limits::Finite },
      { "CheckpointInterval", this->CheckpointInterval, waft::limits::Finite } },
    [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

int vtkSPHSpacetimeFilter::RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                                              vtkInformationVector* outputs)
{
  waft::PassTimeSteps(this, inputs, outputs);
  // The wind's lattice depends on the volume alone.
  waft::SceneInfo info;
  if (vtkPolyData* tracks = vtkPolyData::GetData(inputs[PlannedPort]))
  {
    (void)waft::SceneInfoFromFieldData(tracks, info);
  }
  const std::array<int, 3> n = waft::WindLatticeDimensions(info.Bounds);
  const int extent[6] = { 0, n[0] - 1, 0, n[1] - 1, 0, n[2] - 1 };
  outputs->GetInformationObject(WindPort)->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(),
                                               extent, 6);
  return 1;
}

int vtkSPHSpacetimeFilter::RequestUpdateExtent(vtkInformation* request,
                                               vtkInformationVector** inputs,
                                               vtkInformationVector* outputs)
{
  return this->Impl->RequestUpdateExtent(request, inputs, outputs);
}

int vtkSPHSpacetimeFilter::RequestData(vtkInformation* request, vtkInformationVector** inputs,
                                       vtkInformationVector* outputs)
{
  return this->Impl->RequestData(request, inputs, outputs);
}

void vtkSPHSpacetimeFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfGasParticles: " << this->NumberOfGasParticles << "\n";
  os << indent << "NumberOfObjectParticles: " << this->NumberOfObjectParticles << "\n";
  os << indent << "PositionWeight: " << this->PositionWeight << "\n";
  os << indent << "VelocityWeight: " << this->VelocityWeight << "\n";
  os << indent << "CoherenceWeight: " << this->CoherenceWeight << "\n";
  os << indent << "SpatialShare: " << this->SpatialShare << "\n";
  os << indent << "ObjectCoherence: " << this->ObjectCoherence << "\n";
  os << indent << "ObjectPosition: " << this->ObjectPosition << "\n";
  os << indent << "TemporalWindow: " << this->TemporalWindow << "\n";
  os << indent << "SmoothingLength: " << this->SmoothingLength << "\n";
  os << indent << "CourantNumber: " << this->CourantNumber << "\n";
  os << indent << "Viscosity: " << this->Viscosity << "\n";
  os << indent << "XsphFactor: " << this->XsphFactor << "\n";
  os << indent << "PressureExponent: " << this->PressureExponent << "\n";
  os << indent << "EffectiveGravity: " << this->EffectiveGravity << "\n";
  os << indent << "ContactDistance: " << this->ContactDistance << "\n";
  os << indent << "WindDrag: " << this->WindDrag << "\n";
  os << indent << "EstimateWind: " << this->EstimateWind << "\n";
  os << indent << "FitVortexFields: " << this->FitVortexFields << "\n";
  os << indent << "Passes: " << this->Passes << "\n";
  os << indent << "UseLeash: " << this->UseLeash << "\n";
  os << indent << "LeashIterations: " << this->LeashIterations << "\n";
  os << indent << "MaximumNumberOfVortices: " << this->MaximumNumberOfVortices << "\n";
  os << indent << "MaximumNumberOfIterations: " << this->MaximumNumberOfIterations << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "TimeLimit: " << this->TimeLimit << "\n";
  os << indent << "HistorySize: " << this->HistorySize << "\n";
  os << indent << "WarmStart: " << this->WarmStart << "\n";
  os << indent << "EditDuration: " << this->EditDuration << "\n";
  os << indent << "EditRadius: " << this->EditRadius << "\n";
  os << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
  os << indent << "CheckpointFile: " << this->CheckpointFile << "\n";
  os << indent << "CheckpointInterval: " << this->CheckpointInterval << "\n";
  os << indent << "Controller: " << this->Controller.Get() << "\n";
}
