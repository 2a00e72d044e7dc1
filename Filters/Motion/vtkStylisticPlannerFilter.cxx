// SPDX-License-Identifier: BSD-3-Clause
#include "vtkStylisticPlannerFilter.h"

#include "Bridge/DatabaseConversion.h"
#include "Bridge/FieldCollectors.h"
#include "Bridge/SceneData.h"
#include "Bridge/StageExecution.h"
#include "Bridge/TrackData.h"
#include "Bridge/TreeData.h"
#include "Planning/Planner.h"

#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkTable.h>

vtkStandardNewMacro(vtkStylisticPlannerFilter);

namespace
{

enum InputPort
{
  DatabasePort,
  ObjectsPort,
  ConstraintsPort,
  ObstaclesPort,
  NumberOfInputs
};

enum OutputPort
{
  TracksPort,
  TreesPort,
  ReportPort,
  AssignedPort,
  VorticesPort,
  NumberOfOutputs
};

} // namespace

struct vtkStylisticPlannerFilter::Internals
{
  waft::StageCache Cache;
  waft::TimeSweep Sweep{ { ObstaclesPort } };
  waft::ObstacleCollector Collector;
  waft::SceneInfo Info;
  waft::PlanOutput Plan;

  waft::Result Gather(vtkInformationVector** inputs, bool isFirst);
  waft::Result Run(vtkInformationVector** inputs, const waft::PlanOptions& options,
                   waft::Monitor& monitor);
  void Fill(vtkInformationVector* outputs) const;
};

waft::Result vtkStylisticPlannerFilter::Internals::Gather(vtkInformationVector** inputs,
                                                          bool isFirst)
{
  if (isFirst)
  {
    this->Info = waft::SceneInfo();
    WAFT_RETURN_IF_FAILED(
      waft::SceneInfoFromFieldData(vtkPolyData::GetData(inputs[ObjectsPort]), this->Info));
    this->Collector = waft::ObstacleCollector();
  }
  vtkPolyData* obstacles = vtkPolyData::GetData(inputs[ObstaclesPort]);
  if (obstacles == nullptr || obstacles->GetNumberOfPoints() == 0)
  {
    return waft::Result::Ok();
  }
  const double time = waft::TimeSweep::DataTime(inputs[ObstaclesPort]->GetInformationObject(0));
  return this->Collector.Add(obstacles, time, this->Info.Time);
}

waft::Result vtkStylisticPlannerFilter::Internals::Run(vtkInformationVector** inputs,
                                                       const waft::PlanOptions& options,
                                                       waft::Monitor& monitor)
{
  waft::MotionDatabase database;
  WAFT_RETURN_IF_FAILED(
    waft::DatabaseFromMultiBlock(vtkMultiBlockDataSet::GetData(inputs[DatabasePort]), database));
  std::vector<waft::MotionObject> objects;
  WAFT_RETURN_IF_FAILED(
    waft::ObjectsFromPolyData(vtkPolyData::GetData(inputs[ObjectsPort]), objects));
  std::vector<waft::Constraint> constraints;
  vtkPolyData* rows = vtkPolyData::GetData(inputs[ConstraintsPort]);
  if (rows != nullptr && rows->GetNumberOfPoints() > 0)
  {
    WAFT_RETURN_IF_FAILED(waft::ConstraintsFromPolyData(rows, this->Info.Time, constraints));
  }
  waft::ObstacleSet obstacles;
  WAFT_RETURN_IF_FAILED(obstacles.Build(this->Collector.Take()));
  const waft::PlanInput input{ database, objects, constraints, obstacles, this->Info };
  return waft::PlanMotion(input, options, waft::SmpFor(), monitor, this->Plan);
}

void vtkStylisticPlannerFilter::Internals::Fill(vtkInformationVector* outputs) const
{
  waft::TracksToPolyData(this->Plan.Tracks, this->Info, vtkPolyData::GetData(outputs, TracksPort));
  waft::TreesToPolyData(this->Plan.Trees, this->Info, vtkPolyData::GetData(outputs, TreesPort));
  waft::ReportToTable(this->Plan.Report, this->Info, vtkTable::GetData(outputs, ReportPort));
  waft::ConstraintsToPolyData(this->Plan.Constraints, this->Info,
                              vtkPolyData::GetData(outputs, AssignedPort));
  waft::VorticesToPolyData(this->Plan.Vortices, this->Info,
                           vtkPolyData::GetData(outputs, VorticesPort));
  for (int port = 0; port < NumberOfOutputs; ++port)
  {
    waft::RequestedTime(outputs, port, this->Info.Time);
  }
}

vtkStylisticPlannerFilter::vtkStylisticPlannerFilter() : Impl(std::make_unique<Internals>())
{
  this->SetNumberOfInputPorts(NumberOfInputs);
  this->SetNumberOfOutputPorts(NumberOfOutputs);
}

vtkStylisticPlannerFilter::~vtkStylisticPlannerFilter() = default;

int vtkStylisticPlannerFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(),
            port == DatabasePort ? "vtkMultiBlockDataSet" : "vtkPolyData");
  if (port == ObstaclesPort)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkStylisticPlannerFilter::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == ReportPort ? "vtkTable" : "vtkPolyData");
  return 1;
}

int vtkStylisticPlannerFilter::RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                                                  vtkInformationVector* outputs)
{
  waft::PassTimeSteps(this, inputs, outputs);
  return 1;
}

int vtkStylisticPlannerFilter::RequestUpdateExtent(vtkInformation*, vtkInformationVector** inputs,
                                                   vtkInformationVector*)
{
  this->Impl->Sweep.RequestSteps(this, inputs, this->Impl->Cache.IsCurrent(this, inputs));
  return 1;
}

int vtkStylisticPlannerFilter::RequestData(vtkInformation* request, vtkInformationVector** inputs,
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
    waft::PlanOptions options;
    options.Seed = static_cast<std::uint64_t>(this->Seed);
    options.Freedom = static_cast<waft::RotationFreedom>(this->RotationFreedom);
    options.MaximumTilt = this->MaxTilt;
    options.ConnectionThreshold = this->ConnectionThreshold;
    options.JoinThreshold = this->JoinThreshold;
    options.NumberOfCandidates = this->NumberOfCandidates;
    options.MaximumNumberOfBranches = this->MaximumNumberOfBranches;
    options.RetimingLimit = this->RetimingLimit;
    waft::StageMonitor monitor(this);
    result = result ? impl.Run(inputs, options, monitor) : result;
    if (!result)
    {
      return waft::Fail(this, outputs, result.Message());
    }
    if (!result.IsStopped())
    {
      impl.Cache.MarkCurrent(this, inputs);
    }
  }
  impl.Fill(outputs);
  return 1;
}

void vtkStylisticPlannerFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "RotationFreedom: " << this->RotationFreedom << "\n";
  os << indent << "MaxTilt: " << this->MaxTilt << "\n";
  os << indent << "ConnectionThreshold: " << this->ConnectionThreshold << "\n";
  os << indent << "JoinThreshold: " << this->JoinThreshold << "\n";
  os << indent << "NumberOfCandidates: " << this->NumberOfCandidates << "\n";
  os << indent << "MaximumNumberOfBranches: " << this->MaximumNumberOfBranches << "\n";
  os << indent << "RetimingLimit: " << this->RetimingLimit << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
}
