// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSPHSpacetimeFilter.h"

#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/SpacetimeData.h"
#include "Bridge/Data/TrackData.h"
#include "Bridge/Data/VortexData.h"
#include "Bridge/Pipeline/KeptStage.h"
#include "Bridge/Pipeline/Ranks.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageInputs.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Chain/Motion.h"
#include "Spacetime/Run/Spacetime.h"

#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiProcessController.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTable.h>

#include <set>
#include <string>

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
  AirPort,
};

enum OutputPort
{
  TracksPort,
  ParticlesPort,
  VorticesPort,
  WindPort,
  ConvergencePort,
  ReportPort,
};

} // namespace

struct vtkSPHSpacetimeFilter::Internals : waft::KeptStage
{
  vtkSPHSpacetimeFilter* Self;
  waft::SpacetimeOutput Solution;

  explicit Internals(vtkSPHSpacetimeFilter* self) :
    KeptStage(self, PlannedPort, ObstaclesPort, BackgroundPort, AirPort), Self(self)
  {
  }
  ~Internals() override { this->Discard(); }
  waft::Result Take(vtkInformationVector** inputs, waft::SpacetimeInput& input);
  waft::Result Adopt(vtkInformationVector** inputs, const waft::Scene& scene,
                     const waft::Motion& motion) override;
  waft::Result Run(vtkInformationVector** inputs, waft::Monitor& monitor) override;
  double Slice() const override { return this->Self->Slice; }
  void Publish() override;
  void Clear() override { this->Solution = waft::SpacetimeOutput(); }
  waft::Result PublishFrom(vtkInformationVector** inputs) override;
  bool IsActive() const override { return this->Self->Active; }
  waft::Result Agree(const waft::Result& own) override;
  bool RunsOnAllRanks() const override { return true; }
  void KeepSolution();
  void FillVarying(double time, vtkInformationVector* outputs) const override;
};

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
  input.Air = this->Fields.TakeAir();
  WAFT_RETURN_IF_FAILED(input.Wind.Validate("Wind"));
  return input.Air.Validate("Air");
}

// Inputs may have come to the first rank alone.
waft::Result vtkSPHSpacetimeFilter::Internals::Agree(const waft::Result& own)
{
  waft::ControllerCommunicator ranks(this->Self->Controller);
  return waft::ResultOfFirst(ranks, [&own] { return own; });
}

waft::Result vtkSPHSpacetimeFilter::Internals::Run(vtkInformationVector** inputs,
                                                   waft::Monitor& monitor)
{
  waft::ControllerCommunicator ranks(this->Self->Controller);
  this->Solution = waft::SpacetimeOutput();
  waft::SpacetimeInput input;
  const waft::Result taken = this->Take(inputs, input);
  const bool isEmpty = input.Tracks.empty();
  WAFT_RETURN_IF_FAILED(this->Agree(taken));
  const auto solve = [&]
  {
    const auto options = waft::OptionsOf<waft::SpacetimeOptions>(*this->Self);
    return waft::RunSpacetime(input, options, waft::SmpFor(), monitor, this->Solution);
  };
  WAFT_RETURN_IF_FAILED(waft::ResultOfFirst(ranks, solve));
  // A rank that was given the scene gets the result, too, when all were.
  const bool isForAll = ranks.Largest(isEmpty ? 1.0 : 0.0) == 0.0;
  if (isForAll && ranks.Size() > 1)
  {
    waft::BroadcastStream stream(ranks);
    stream.Values(this->Solution);
  }
  this->Rejoin();
  this->Warnings = this->Solution.Warnings;
  if (isForAll || ranks.IsFirst())
  {
    this->KeepSolution();
    waft::AddRowTimes(input.Constraints, this->Kept<vtkPolyData>(TracksPort));
  }
  return waft::Result::Ok(); // also when stopped: the best so far is shown until something changes
}

waft::Result vtkSPHSpacetimeFilter::Internals::Adopt(vtkInformationVector** inputs,
                                                     const waft::Scene&, const waft::Motion& motion)
{
  this->Solution = motion.Optimised;
  std::vector<waft::Constraint> rows;
  WAFT_RETURN_IF_FAILED(this->TakeConstraints(inputs[ConstraintsPort], rows));
  this->KeepSolution();
  waft::AddRowTimes(rows, this->Kept<vtkPolyData>(TracksPort));
  return waft::Result::Ok();
}

void vtkSPHSpacetimeFilter::Internals::KeepSolution()
{
  waft::OptimisedToPolyData(this->Solution, this->Scene, this->Kept<vtkPolyData>(TracksPort));
  waft::VorticesToPolyData(this->Solution.Vortices, this->Scene,
                           this->Kept<vtkPolyData>(VorticesPort));
  waft::ConvergenceToTable(this->Solution.Convergence, this->Scene,
                           this->Kept<vtkTable>(ConvergencePort));
  waft::ReportToTable(this->Solution.Report, this->Scene, this->Kept<vtkTable>(ReportPort));
}

void vtkSPHSpacetimeFilter::Internals::Publish()
{
  waft::TracksToPolyData(this->Solution.Tracks, this->Scene, this->Kept<vtkPolyData>(TracksPort));
  waft::ConvergenceToTable(this->Solution.Convergence, this->Scene,
                           this->Kept<vtkTable>(ConvergencePort));
}

waft::Result vtkSPHSpacetimeFilter::Internals::PublishFrom(vtkInformationVector** inputs)
{
  this->Kept<vtkPolyData>(TracksPort)->ShallowCopy(vtkPolyData::GetData(inputs[PlannedPort]));
  return waft::Result::Ok();
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

vtkSPHSpacetimeFilter::vtkSPHSpacetimeFilter() :
  vtkChainStageAlgorithm(waft::ChainStage::Spacetime), Impl(std::make_unique<Internals>(this))
{
  waft::TakeDefaults<waft::SpacetimeOptions>(*this);
  this->Controller = vtkMultiProcessController::GetGlobalController();
}

vtkSPHSpacetimeFilter::~vtkSPHSpacetimeFilter() = default;

double vtkSPHSpacetimeFilter::InRange(const char* property, double value)
{
  return waft::InRange<waft::SpacetimeOptions>(property, value);
}

waft::KeptStage& vtkSPHSpacetimeFilter::Kept()
{
  return *this->Impl;
}

void vtkSPHSpacetimeFilter::SetController(vtkMultiProcessController* controller)
{
  if (this->Controller != controller)
  {
    this->Controller = controller;
    this->Modified();
  }
}

void vtkSPHSpacetimeFilter::Continue()
{
  this->Modified();
}

void vtkSPHSpacetimeFilter::Restart()
{
  this->Modified();
}

std::vector<waft::PropertyRange> vtkSPHSpacetimeFilter::Ranges() const
{
  return waft::RangesOf<waft::SpacetimeOptions>(*this);
}

int vtkSPHSpacetimeFilter::RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                                              vtkInformationVector* outputs)
{
  waft::PassTimeSteps(this, inputs, outputs);
  // The wind's lattice depends on the volume alone.
  waft::SceneInfo info;
  std::set<std::string> lacking;
  (void)waft::SceneOfInputs(this, inputs, PlannedPort, info, lacking);
  const std::array<int, 3> n =
    waft::WindLatticeDimensions(info.Bounds, waft::OptionsOf<waft::SpacetimeOptions>(*this));
  const int extent[6] = { 0, n[0] - 1, 0, n[1] - 1, 0, n[2] - 1 };
  outputs->GetInformationObject(WindPort)->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(),
                                               extent, 6);
  return 1;
}

void vtkSPHSpacetimeFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::SpacetimeOptions>(os, indent, *this);
}
