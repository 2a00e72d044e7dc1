// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTrajectoryClusterFilter.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Arrays.h"
#include "Bridge/Data/DatabaseConversion.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/TrackData.h"
#include "Bridge/Data/VortexData.h"
#include "Bridge/Pipeline/SlicedStage.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageInputs.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Trajectory/TrajectoryClusters.h"

#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <set>
#include <string>

vtkStandardNewMacro(vtkTrajectoryClusterFilter);

namespace
{

// One connection of the inputs as a simulation; the first one gives rate, volume and settling, and
// `lacking` gets what of these it does not have.
waft::Result AddSimulation(vtkPolyData* tracks, vtkPolyData* vortices, waft::ClusterInput& input,
                           std::set<std::string>& lacking)
{
  waft::TracedSimulation simulation;
  WAFT_RETURN_IF_FAILED(waft::TracksFromPolyData(tracks, simulation.Tracks, "Input"));
  if (vortices)
  {
    WAFT_RETURN_IF_FAILED(waft::VorticesFromPolyData(vortices, simulation.Vortices));
  }
  waft::SceneInfo info;
  if (vortices)
  {
    WAFT_RETURN_IF_FAILED(waft::SceneInfoFromFieldData(vortices, info));
  }
  WAFT_RETURN_IF_FAILED(waft::SceneInfoFromFieldData(tracks, info));
  for (const char* name : { waft::names::Bounds, waft::names::FramesPerSecond })
  {
    if (input.Simulations.empty() && !tracks->GetFieldData()->HasArray(name) &&
        !(vortices && vortices->GetFieldData()->HasArray(name)))
    {
      lacking.insert(name);
    }
  }
  if (input.Simulations.empty())
  {
    input.FramesPerSecond = info.Time.FramesPerSecond;
    input.Volume = info.Bounds;
    input.SettlingSpeed = 0.0;
    WAFT_RETURN_IF_FAILED(
      waft::ReadNumber(tracks->GetFieldData(), "Input: field data", waft::names::SettlingSpeed,
                       waft::limits::UpTo(waft::limits::Speed.High), input.SettlingSpeed));
  }
  else if (info.Time.FramesPerSecond != input.FramesPerSecond)
  {
    return waft::Result::Error("Input " + std::to_string(input.Simulations.size()) +
                               ": field data `FramesPerSecond`: " + "expected " +
                               std::to_string(input.FramesPerSecond) + " as in the first");
  }
  input.Simulations.push_back(std::move(simulation));
  return waft::Result::Ok();
}

waft::Result Gather(vtkInformationVector** inputs, waft::ClusterInput& input,
                    std::set<std::string>& lacking)
{
  for (int i = 0; i < inputs[0]->GetNumberOfInformationObjects(); ++i)
  {
    const bool hasVortices = i < inputs[1]->GetNumberOfInformationObjects();
    WAFT_RETURN_IF_FAILED(AddSimulation(vtkPolyData::GetData(inputs[0], i),
                                        hasVortices ? vtkPolyData::GetData(inputs[1], i) : nullptr,
                                        input, lacking));
  }
  return waft::Result::Ok();
}

using waft::StageInput;

const waft::StageInputs Inputs = {
  { "Input", StageInput::Type::Surface, StageInput::Number::Any },
  { "Vortices", StageInput::Type::Merged, StageInput::Number::AnyOrNone },
};

} // namespace

struct vtkTrajectoryClusterFilter::Internals : waft::KeptStage
{
  vtkTrajectoryClusterFilter* Self;

  explicit Internals(vtkTrajectoryClusterFilter* self) :
    KeptStage(self, waft::FieldSweep::NoPort), Self(self)
  {
  }
  ~Internals() override { this->Discard(); }
  double Slice() const override { return this->Self->Slice; }
  bool HasTime() const override { return false; }
  waft::Result Run(vtkInformationVector** inputs, waft::Monitor& monitor) override;
  waft::ClusterOptions Options() const;
};

waft::ClusterOptions vtkTrajectoryClusterFilter::Internals::Options() const
{
  waft::ClusterOptions options;
  waft::CopyFields<waft::ClusterOptions>(*this->Self, options);
  waft::CopyFields<waft::SegmentationOptions>(*this->Self, options.Segmentation);
  waft::CopyFields<waft::ClusterTreeOptions>(*this->Self, options.Trees);
  waft::CopyFields<waft::ConnectionOptions>(*this->Self, options.Connections);
  return options;
}

waft::Result vtkTrajectoryClusterFilter::Internals::Run(vtkInformationVector** inputs,
                                                        waft::Monitor& monitor)
{
  const waft::ClusterOptions options = this->Options();
  waft::ClusterInput input;
  std::set<std::string> lacking;
  WAFT_RETURN_IF_FAILED(Gather(inputs, input, lacking));
  waft::MotionDatabase database;
  const waft::Result result =
    waft::ClusterTrajectories(input, options, waft::SmpFor(), monitor, database);
  this->Rejoin();
  if (!lacking.empty())
  {
    waft::SceneInfo taken;
    taken.Bounds = input.Volume;
    taken.Time.FramesPerSecond = input.FramesPerSecond;
    this->Warnings.push_back(waft::DefaultsText(lacking, taken));
  }
  if (result && !result.IsStopped())
  {
    waft::DatabaseToMultiBlock(database, this->KeptStage::Kept<vtkMultiBlockDataSet>(0));
  }
  return result;
}

vtkTrajectoryClusterFilter::vtkTrajectoryClusterFilter() : Impl(std::make_unique<Internals>(this))
{
  waft::TakeDefaults<waft::ClusterOptions, waft::SegmentationOptions, waft::ClusterTreeOptions,
                     waft::ConnectionOptions>(*this);
  this->SetNumberOfInputPorts(2);
}

vtkTrajectoryClusterFilter::~vtkTrajectoryClusterFilter() = default;

double vtkTrajectoryClusterFilter::InRange(const char* property, double value)
{
  return waft::InRange<waft::ClusterOptions, waft::SegmentationOptions, waft::ClusterTreeOptions,
                       waft::ConnectionOptions>(property, value);
}

int vtkTrajectoryClusterFilter::FillInputPortInformation(int port, vtkInformation* info)
{
  return waft::FillInput(Inputs, port, info);
}

vtkTypeBool vtkTrajectoryClusterFilter::ProcessRequest(vtkInformation* request,
                                                       vtkInformationVector** inputs,
                                                       vtkInformationVector* outputs)
{
  return waft::GuardedRequest(
    this, request, inputs, outputs, Inputs,
    waft::RangesOf<waft::ClusterOptions, waft::SegmentationOptions, waft::ClusterTreeOptions,
                   waft::ConnectionOptions, waft::SliceOptions>(*this),
    [&](vtkInformationVector** taken)
    { return this->Superclass::ProcessRequest(request, taken, outputs); });
}

int vtkTrajectoryClusterFilter::RequestInformation(vtkInformation*, vtkInformationVector**,
                                                   vtkInformationVector* outputs)
{
  // A database has no time: a stage that pulls its inputs over time must not pull the tracks.
  outputs->GetInformationObject(0)->Remove(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
  outputs->GetInformationObject(0)->Remove(vtkStreamingDemandDrivenPipeline::TIME_RANGE());
  return 1;
}

int vtkTrajectoryClusterFilter::RequestData(vtkInformation* request, vtkInformationVector** inputs,
                                            vtkInformationVector* outputs)
{
  return this->Impl->RequestData(request, inputs, outputs);
}

waft::KeptStage& vtkTrajectoryClusterFilter::Kept()
{
  return *this->Impl;
}

WaftSlicesOf(vtkTrajectoryClusterFilter);

void vtkTrajectoryClusterFilter::RemoveAllVortices()
{
  this->SetInputConnection(1, nullptr);
}

void vtkTrajectoryClusterFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::ClusterOptions, waft::SegmentationOptions, waft::ClusterTreeOptions,
                    waft::ConnectionOptions, waft::SliceOptions>(os, indent, *this);
}
