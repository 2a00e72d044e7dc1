// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSPHSpacetimeFilter.h"

#include "Bridge/ArrayNames.h"
#include "Bridge/Arrays.h"
#include "Bridge/FieldCollectors.h"
#include "Bridge/SceneData.h"
#include "Bridge/SpacetimeData.h"
#include "Bridge/StageExecution.h"
#include "Bridge/TrackData.h"
#include "Spacetime/Spacetime.h"

#include <vtkCellData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTable.h>

#include <cmath>

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

struct vtkSPHSpacetimeFilter::Internals
{
  waft::StageCache Cache;
  waft::TimeSweep Sweep{ { ObstaclesPort, BackgroundPort } };
  waft::ObstacleCollector Obstacles;
  waft::FieldCollector Background;
  waft::SceneInfo Info;
  waft::SpacetimeOutput Result;

  static waft::SpacetimeOptions Options(const vtkSPHSpacetimeFilter& stage);
  waft::Result Gather(vtkInformationVector** inputs, bool isFirst);
  waft::Result Run(vtkInformationVector** inputs, const waft::SpacetimeOptions& options,
                   waft::Monitor& monitor);
  void Fill(vtkInformation* request, vtkInformationVector* outputs) const;
};

waft::SpacetimeOptions vtkSPHSpacetimeFilter::Internals::Options(const vtkSPHSpacetimeFilter& stage)
{
  waft::SpacetimeOptions options;
  options.NumberOfGasParticles = stage.NumberOfGasParticles;
  options.NumberOfObjectParticles = stage.NumberOfObjectParticles;
  options.PositionWeight = stage.PositionWeight;
  options.VelocityWeight = stage.VelocityWeight;
  options.CoherenceWeight = stage.CoherenceWeight;
  options.SpatialShare = stage.SpatialShare;
  options.TemporalWindow = stage.TemporalWindow;
  options.SmoothingLength = stage.SmoothingLength;
  options.CourantNumber = stage.CourantNumber;
  options.Viscosity = stage.Viscosity;
  options.XsphFactor = stage.XsphFactor;
  options.PressureExponent = stage.PressureExponent;
  options.EffectiveGravity = stage.EffectiveGravity;
  options.ContactDistance = stage.ContactDistance;
  options.WindDrag = stage.WindDrag;
  options.EstimateWind = stage.EstimateWind;
  options.FitVortexFields = stage.FitVortexFields;
  options.Passes = stage.Passes;
  options.UseLeash = stage.UseLeash;
  options.LeashIterations = stage.LeashIterations;
  options.MaximumNumberOfIterations = stage.MaximumNumberOfIterations;
  options.Tolerance = stage.Tolerance;
  options.TimeLimit = stage.TimeLimit;
  options.HistorySize = stage.HistorySize;
  return options;
}

waft::Result vtkSPHSpacetimeFilter::Internals::Gather(vtkInformationVector** inputs, bool isFirst)
{
  if (isFirst)
  {
    this->Info = waft::SceneInfo();
    WAFT_RETURN_IF_FAILED(
      waft::SceneInfoFromFieldData(vtkPolyData::GetData(inputs[PlannedPort]), this->Info));
    this->Obstacles = waft::ObstacleCollector();
    this->Background = waft::FieldCollector();
  }
  vtkPolyData* obstacles = vtkPolyData::GetData(inputs[ObstaclesPort]);
  if (obstacles != nullptr && obstacles->GetNumberOfPoints() > 0)
  {
    const double time = waft::TimeSweep::DataTime(inputs[ObstaclesPort]->GetInformationObject(0));
    WAFT_RETURN_IF_FAILED(this->Obstacles.Add(obstacles, time, this->Info.Time));
  }
  vtkImageData* wind = vtkImageData::GetData(inputs[BackgroundPort]);
  if (wind != nullptr && wind->GetNumberOfPoints() > 0)
  {
    const double time = waft::TimeSweep::DataTime(inputs[BackgroundPort]->GetInformationObject(0));
    WAFT_RETURN_IF_FAILED(this->Background.Add(wind, time));
  }
  return waft::Result::Ok();
}

waft::Result vtkSPHSpacetimeFilter::Internals::Run(vtkInformationVector** inputs,
                                                   const waft::SpacetimeOptions& options,
                                                   waft::Monitor& monitor)
{
  waft::SpacetimeInput input;
  input.Scene = this->Info;
  WAFT_RETURN_IF_FAILED(
    waft::TracksFromPolyData(vtkPolyData::GetData(inputs[PlannedPort]), input.Tracks));
  WAFT_RETURN_IF_FAILED(
    waft::ObjectsFromPolyData(vtkPolyData::GetData(inputs[ObjectsPort]), input.Objects));
  vtkPolyData* rows = vtkPolyData::GetData(inputs[ConstraintsPort]);
  if (rows != nullptr && rows->GetNumberOfPoints() > 0)
  {
    WAFT_RETURN_IF_FAILED(waft::ConstraintsFromPolyData(rows, this->Info.Time, input.Constraints));
  }
  vtkPolyData* vortices = vtkPolyData::GetData(inputs[GuessedVorticesPort]);
  if (vortices != nullptr)
  {
    WAFT_RETURN_IF_FAILED(waft::VorticesFromPolyData(vortices, input.Vortices));
  }
  input.Obstacles = this->Obstacles.Take();
  input.Wind = this->Background.Take();
  WAFT_RETURN_IF_FAILED(input.Wind.Validate("Wind"));
  this->Result = waft::SpacetimeOutput();
  return waft::RunSpacetime(input, options, waft::SmpFor(), monitor, this->Result);
}

void vtkSPHSpacetimeFilter::Internals::Fill(vtkInformation* request,
                                            vtkInformationVector* outputs) const
{
  const double time = waft::RequestedTimeOfAll(request, outputs, this->Info.Time);
  const int frame = static_cast<int>(std::lround(time * this->Info.Time.FramesPerSecond));
  vtkPolyData* tracks = vtkPolyData::GetData(outputs, TracksPort);
  waft::TracksToPolyData(this->Result.Tracks, this->Info, tracks);
  waft::AddDoubles(tracks->GetCellData(), waft::names::PositionResidual,
                   this->Result.PositionResiduals);
  waft::AddDoubles(tracks->GetCellData(), waft::names::VelocityResidual,
                   this->Result.VelocityResiduals);
  waft::ParticlesToPolyData(this->Result.Particles, frame, this->Info,
                            vtkPolyData::GetData(outputs, ParticlesPort));
  waft::VorticesToPolyData(this->Result.Vortices, this->Info,
                           vtkPolyData::GetData(outputs, VorticesPort));
  waft::FieldSeriesToImage(this->Result.Wind, time, this->Info,
                           vtkImageData::GetData(outputs, WindPort));
  waft::ConvergenceToTable(this->Result.Convergence, this->Info,
                           vtkTable::GetData(outputs, ConvergencePort));
  waft::ReportToTable(this->Result.Report, this->Info, vtkTable::GetData(outputs, ReportPort));
  waft::RequestedTimeOfAll(request, outputs, this->Info.Time);
}

vtkSPHSpacetimeFilter::vtkSPHSpacetimeFilter() : Impl(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(NumberOfInputs);
  this->SetNumberOfOutputPorts(NumberOfOutputs);
}

vtkSPHSpacetimeFilter::~vtkSPHSpacetimeFilter() = default;

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

int vtkSPHSpacetimeFilter::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs,
                                               vtkInformationVector*)
{
  this->Impl->Sweep.RequestSteps(this, inputs, this->Impl->Cache.IsCurrent(this, inputs));
  return 1;
}

int vtkSPHSpacetimeFilter::RequestData(vtkInformation* request, vtkInformationVector** inputs,
                                       vtkInformationVector* outputs)
{
  Internals& impl = *this->Impl;
  if (!impl.Cache.IsCurrent(this, inputs))
  {
    waft::Result result = impl.Gather(inputs, impl.Sweep.IsFirst());
    if (result && impl.Sweep.Continue(request))
    {
      return 1;
    }
    impl.Sweep.Reset(request);
    impl.Cache.Forget();
    waft::StageMonitor monitor(this);
    result = result ? impl.Run(inputs, Internals::Options(*this), monitor) : result;
    if (!result)
    {
      return waft::Fail(this, outputs, result.Message());
    }
    for (const std::string& warning : impl.Result.Warnings)
    {
      vtkWarningMacro(<< warning);
    }
    impl.Cache.MarkCurrent(this, inputs);
  }
  impl.Fill(request, outputs);
  return 1;
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
  os << indent << "MaximumNumberOfIterations: " << this->MaximumNumberOfIterations << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "TimeLimit: " << this->TimeLimit << "\n";
  os << indent << "HistorySize: " << this->HistorySize << "\n";
}
