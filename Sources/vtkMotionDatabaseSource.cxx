// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMotionDatabaseSource.h"

#include "Bridge/DatabaseConversion.h"
#include "Bridge/StageExecution.h"
#include "Database/DatabaseBuild.h"

#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkSMPTools.h>
#include <vtkTable.h>

#include <algorithm>
#include <chrono>

vtkStandardNewMacro(vtkMotionDatabaseSource);

namespace
{

/// Progress and abort of a stage, and an end in time.
class TimedMonitor : public waft::StageMonitor
{
public:
  /// limit: s; 0: none.
  TimedMonitor(vtkAlgorithm* stage, double limit) : StageMonitor(stage), Limit(limit) {}
  bool Tick(double fraction, const std::string& text) override
  {
    const std::chrono::duration<double> passed = Clock::now() - this->Start;
    return StageMonitor::Tick(fraction, text) &&
           (this->Limit <= 0.0 || passed.count() < this->Limit);
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point Start = Clock::now();
  double Limit;
};

} // namespace

struct vtkMotionDatabaseSource::Internals
{
  waft::StageCache Cache;
  vtkNew<vtkMultiBlockDataSet> Kept; // the database
  vtkNew<vtkTable> KeptCoverage;

  static waft::DatabaseOptions Options(vtkMotionDatabaseSource* self);
};

waft::DatabaseOptions vtkMotionDatabaseSource::Internals::Options(vtkMotionDatabaseSource* self)
{
  const auto range = [](const double* ends) { return waft::Range{ ends[0], ends[1] }; };
  waft::DatabaseOptions options;
  options.NumberOfSimulations = self->NumberOfSimulations;
  options.StopBelow = self->StopBelow;
  options.CoverageTolerance = self->CoverageTolerance;
  options.KeptIn = self->KeptIn;
  options.NumberOfFrames = self->NumberOfFrames;
  options.FramesPerSecond = self->FramesPerSecond;
  const double* b = self->Bounds;
  options.Bounds = waft::Box{ waft::Vec3(b[0], b[2], b[4]), waft::Vec3(b[1], b[3], b[5]) };
  options.Resolution = self->Resolution;
  options.WarmUpSeconds = self->WarmUpSeconds;
  options.SettlingSpeed = self->SettlingSpeed;
  options.Seed = static_cast<std::uint64_t>(self->Seed);
  options.Trace.SeedStride = self->SeedStride;
  options.Ensemble.NumberOfVortices = self->NumberOfVortices;
  options.Ensemble.NumberOfWinds = self->NumberOfWinds;
  options.Ensemble.NumberOfObstacles = self->NumberOfObstacles;
  options.Ensemble.VortexDiameter = range(self->VortexDiameter);
  options.Ensemble.VortexLength = range(self->VortexLength);
  options.Ensemble.VortexAcceleration = range(self->VortexAcceleration);
  options.Ensemble.VortexDuration = range(self->VortexDuration);
  options.Ensemble.WindRadius = range(self->WindRadius);
  options.Ensemble.WindAcceleration = range(self->WindAcceleration);
  options.Ensemble.WindDuration = range(self->WindDuration);
  options.Ensemble.ObstacleSize = range(self->ObstacleSize);
  options.Cluster.MaximumSegments = self->MaximumSegments;
  options.Cluster.RelativeError = self->RelativeError;
  options.Cluster.Trees.NumberOfTopNodes = self->NumberOfTopNodes;
  options.Cluster.Connections.NotConnectible = self->NotConnectible;
  options.Cluster.Connections.RotationFreedom =
    static_cast<waft::RotationFreedom>(self->RotationFreedom);
  return options;
}

vtkMotionDatabaseSource::vtkMotionDatabaseSource() : Impl(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(2);
}

vtkMotionDatabaseSource::~vtkMotionDatabaseSource() = default;

int vtkMotionDatabaseSource::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkMultiBlockDataSet" : "vtkTable");
  return 1;
}

vtkTypeBool vtkMotionDatabaseSource::ProcessRequest(vtkInformation* request,
                                                    vtkInformationVector** inputs,
                                                    vtkInformationVector* outputs)
{
  return waft::GuardedRequest(
    this, request, outputs,
    { { "NumberOfSimulations", this->NumberOfSimulations, waft::limits::UpTo(1e6) },
      { "StopBelow", this->StopBelow, waft::limits::Finite },
      { "CoverageTolerance", this->CoverageTolerance, waft::limits::Finite },
      { "TimeLimit", this->TimeLimit, waft::limits::Finite },
      { "NumberOfFrames", this->NumberOfFrames,
        waft::limits::Range{ 1, waft::limits::Frames.High } },
      { "Resolution", this->Resolution, waft::limits::Range{ 1, 4096 } },
      { "NumberOfVortices", this->NumberOfVortices, waft::limits::UpTo(1e4) },
      { "NumberOfWinds", this->NumberOfWinds, waft::limits::UpTo(1e4) },
      { "NumberOfObstacles", this->NumberOfObstacles, waft::limits::UpTo(1e4) },
      { "NumberOfTopNodes", this->NumberOfTopNodes, waft::limits::UpTo(1e6) },
      { "Bounds", this->Bounds, waft::limits::Coordinate },
      { "FramesPerSecond", this->FramesPerSecond, waft::limits::FramesPerSecond },
      { "WarmUpSeconds", this->WarmUpSeconds, waft::limits::UpTo(1e6) },
      { "SettlingSpeed", this->SettlingSpeed, waft::limits::UpTo(waft::limits::Speed.High) },
      { "RelativeError", this->RelativeError, waft::limits::Around0(1e9) },
      { "NotConnectible", this->NotConnectible, waft::limits::Around0(1e9) },
      { "VortexDiameter", this->VortexDiameter, waft::limits::Distance },
      { "VortexLength", this->VortexLength, waft::limits::Distance },
      { "VortexAcceleration", this->VortexAcceleration, waft::limits::Around0(1e9) },
      { "VortexDuration", this->VortexDuration, waft::limits::UpTo(1e9) },
      { "WindRadius", this->WindRadius, waft::limits::Distance },
      { "WindAcceleration", this->WindAcceleration, waft::limits::Around0(1e9) },
      { "WindDuration", this->WindDuration, waft::limits::UpTo(1e9) },
      { "ObstacleSize", this->ObstacleSize, waft::limits::Distance } },
    [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

int vtkMotionDatabaseSource::RequestData(vtkInformation*, vtkInformationVector** inputs,
                                         vtkInformationVector* outputs)
{
  Internals& impl = *this->Impl;
  if (!impl.Cache.IsCurrent(this, inputs))
  {
    waft::DatabaseOptions options = Internals::Options(this);
    impl.Cache.Forget();
    waft::MotionDatabase database;
    std::vector<waft::CoveragePoint> coverage;
    TimedMonitor monitor(this, this->TimeLimit);
    const waft::ParallelFor parallelFor = waft::SmpFor();
    options.SimulationsAtOnce = std::clamp(vtkSMPTools::GetEstimatedNumberOfThreads(), 1, 32);
    const waft::Result result =
      waft::BuildDatabase(options, parallelFor, monitor, database, coverage);
    if (!result)
    {
      return waft::Fail(this, outputs, result.Message());
    }
    if (result.IsStopped() && database.Segments.empty())
    {
      vtkMultiBlockDataSet::GetData(outputs)->Initialize();
      vtkTable::GetData(outputs, 1)->Initialize();
      return 1;
    }
    waft::DatabaseToMultiBlock(database, impl.Kept);
    waft::CoverageToTable(coverage, impl.KeptCoverage);
    if (!result.IsStopped())
    {
      impl.Cache.MarkCurrent(this, inputs);
    }
  }
  vtkMultiBlockDataSet::GetData(outputs)->ShallowCopy(impl.Kept);
  vtkTable::GetData(outputs, 1)->ShallowCopy(impl.KeptCoverage);
  return 1;
}

void vtkMotionDatabaseSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto print = [&os, indent](const char* name, const double* ends)
  { os << indent << name << ": " << ends[0] << " " << ends[1] << "\n"; };
  os << indent << "NumberOfSimulations: " << this->NumberOfSimulations << "\n";
  os << indent << "StopBelow: " << this->StopBelow << "\n";
  os << indent << "CoverageTolerance: " << this->CoverageTolerance << "\n";
  os << indent << "KeptIn: " << this->KeptIn << "\n";
  os << indent << "TimeLimit: " << this->TimeLimit << "\n";
  os << indent << "NumberOfFrames: " << this->NumberOfFrames << "\n";
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "SeedStride: " << this->SeedStride << "\n";
  os << indent << "NumberOfVortices: " << this->NumberOfVortices << "\n";
  os << indent << "NumberOfWinds: " << this->NumberOfWinds << "\n";
  os << indent << "NumberOfObstacles: " << this->NumberOfObstacles << "\n";
  os << indent << "MaximumSegments: " << this->MaximumSegments << "\n";
  os << indent << "NumberOfTopNodes: " << this->NumberOfTopNodes << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  const double* b = this->Bounds;
  os << indent << "Bounds: " << b[0] << " " << b[1] << " " << b[2] << " " << b[3] << " " << b[4]
     << " " << b[5] << "\n";
  os << indent << "FramesPerSecond: " << this->FramesPerSecond << "\n";
  os << indent << "WarmUpSeconds: " << this->WarmUpSeconds << "\n";
  os << indent << "SettlingSpeed: " << this->SettlingSpeed << "\n";
  os << indent << "RelativeError: " << this->RelativeError << "\n";
  os << indent << "NotConnectible: " << this->NotConnectible << "\n";
  os << indent << "RotationFreedom: " << this->RotationFreedom << "\n";
  print("VortexDiameter", this->VortexDiameter);
  print("VortexLength", this->VortexLength);
  print("VortexAcceleration", this->VortexAcceleration);
  print("VortexDuration", this->VortexDuration);
  print("WindRadius", this->WindRadius);
  print("WindAcceleration", this->WindAcceleration);
  print("WindDuration", this->WindDuration);
  print("ObstacleSize", this->ObstacleSize);
}
