// SPDX-License-Identifier: BSD-3-Clause
#include "vtkAirAssimilationFilter.h"

#include "Air/Run/AirAssimilation.h"
#include "Air/Run/AssimilationState.h"
#include "Bridge/Data/AirData.h"
#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/ShapeData.h"
#include "Bridge/Data/SharedArrays.h"
#include "Bridge/Data/TrackData.h"
#include "Bridge/Data/VortexData.h"
#include "Bridge/Pipeline/KeptStage.h"
#include "Bridge/Pipeline/Ranks.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageInputs.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Chain/Motion.h"
#include "Grid/NodeSolids.h"

#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkMultiProcessController.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTable.h>

#include <set>
#include <string>

vtkStandardNewMacro(vtkAirAssimilationFilter);

namespace
{

enum InputPort
{
  PlannedPort,
  ObjectsPort,
  RowsPort,
  ObstaclesPort,
  WindPort,
  ScenesVorticesPort,
  ShapesPort,
};

enum OutputPort
{
  TracksPort,
  AirPort,
  VorticesPort,
  ConstraintsPort,
  ReportPort,
  RoundsPort,
};

} // namespace

struct vtkAirAssimilationFilter::Internals : waft::KeptStage
{
  vtkAirAssimilationFilter* Self;
  waft::AssimilationOutput Solution;
  waft::AssimilationState Memory; // of the last run, for the next

  explicit Internals(vtkAirAssimilationFilter* self) :
    KeptStage(self, PlannedPort, ObstaclesPort, WindPort), Self(self)
  {
  }
  ~Internals() override { this->Discard(); }
  waft::Result Take(vtkInformationVector** inputs, waft::AssimilationInput& input);
  waft::Result Adopt(vtkInformationVector** inputs, const waft::Scene& scene,
                     const waft::Motion& motion) override;
  waft::Result KeepSolution(vtkPolyData* planned);
  waft::Result Run(vtkInformationVector** inputs, waft::Monitor& monitor) override;
  double Slice() const override { return this->Self->Slice; }
  void Publish() override;
  waft::Result PublishFrom(vtkInformationVector** inputs) override;
  bool IsActive() const override { return this->Self->Active; }
  void Clear() override
  {
    this->Solution = waft::AssimilationOutput();
    this->Memory = waft::AssimilationState();
  }
  void FillVarying(double time, vtkInformationVector* outputs) const override;
};

waft::Result vtkAirAssimilationFilter::Internals::Take(vtkInformationVector** inputs,
                                                       waft::AssimilationInput& input)
{
  input.Scene = this->Scene;
  WAFT_RETURN_IF_FAILED(
    waft::PathsFromPolyData(vtkPolyData::GetData(inputs[PlannedPort]), input.Tracks, "Tracks"));
  WAFT_RETURN_IF_FAILED(
    waft::ObjectsFromPolyData(vtkPolyData::GetData(inputs[ObjectsPort]), input.Objects));
  WAFT_RETURN_IF_FAILED(this->TakeConstraints(inputs[RowsPort], input.Constraints));
  if (vtkPolyData* vortices = vtkPolyData::GetData(inputs[ScenesVorticesPort]))
  {
    WAFT_RETURN_IF_FAILED(waft::VorticesFromPolyData(vortices, input.Vortices));
  }
  if (auto* shapes = vtkMultiBlockDataSet::GetData(inputs[ShapesPort]))
  {
    WAFT_RETURN_IF_FAILED(waft::BodiesFromMultiBlock(shapes, input.Shapes));
  }
  static_cast<waft::TurningOptions&>(input.Turning) =
    waft::OptionsOf<waft::TurningOptions>(*this->Self);
  input.Obstacles = this->Fields.TakeObstacles();
  input.Wind = this->Fields.TakeWind();
  return input.Wind.Validate("Wind");
}

waft::Result vtkAirAssimilationFilter::Internals::Run(vtkInformationVector** inputs,
                                                      waft::Monitor& monitor)
{
  this->Solution = waft::AssimilationOutput();
  vtkNew<vtkPolyData> planned; // the inputs are those of the request in which the run begins
  planned->ShallowCopy(vtkPolyData::GetData(inputs[PlannedPort]));
  {
    waft::AssimilationInput input;
    WAFT_RETURN_IF_FAILED(this->Take(inputs, input));
    waft::ControllerCommunicator ranks(this->Self->Controller);
    input.Ranks = &ranks;
    const waft::SolidsOn solids = [&input](const waft::SmokeOptions& smoke)
    { return waft::NodeSolids(input.Obstacles, smoke); };
    WAFT_RETURN_IF_FAILED(
      waft::AssimilateAir(input, waft::OptionsOf<waft::AssimilationOptions>(*this->Self), solids,
                          waft::SmpFor(), monitor, this->Solution, &this->Memory));
  }
  this->Rejoin();
  this->Warnings = this->Solution.Warnings;
  return this->KeepSolution(planned);
}

waft::Result vtkAirAssimilationFilter::Internals::Adopt(vtkInformationVector** inputs,
                                                        const waft::Scene&,
                                                        const waft::Motion& motion)
{
  this->Solution = motion.Air;
  return this->KeepSolution(vtkPolyData::GetData(inputs[PlannedPort]));
}

waft::Result vtkAirAssimilationFilter::Internals::KeepSolution(vtkPolyData* planned)
{
  if (this->Solution.Air->Velocity.IsEmpty()) // they are the plan's, with what that says of them
  {
    WAFT_RETURN_IF_FAILED(waft::TracksFromPolyData(planned, this->Solution.Tracks));
  }
  auto* tracks = this->Kept<vtkPolyData>(TracksPort);
  waft::TracksToPolyData(this->Solution.Tracks, this->Scene, tracks);
  waft::AddControls(this->Solution, tracks);
  this->Solution.Tracks = {}; // many, and the output has them
  this->Solution.Controls = {};
  this->Solution.Free = {};
  waft::ShareEqualArrays(planned->GetPointData(), tracks->GetPointData());
  waft::AddRowTimes(this->Solution.Constraints, tracks);
  waft::VorticesToPolyData(this->Solution.Vortices, this->Scene,
                           this->Kept<vtkPolyData>(VorticesPort));
  waft::ConstraintsToPolyData(this->Solution.Constraints, this->Scene,
                              this->Kept<vtkPolyData>(ConstraintsPort));
  waft::ReportToTable(this->Solution.Report, this->Scene, this->Kept<vtkTable>(ReportPort));
  waft::RoundsToTable(this->Solution.Rounds, this->Scene, this->Kept<vtkTable>(RoundsPort));
  return waft::Result::Ok();
}

void vtkAirAssimilationFilter::Internals::Publish()
{
  waft::TracksToPolyData(this->Solution.Tracks, this->Scene, this->Kept<vtkPolyData>(TracksPort));
  waft::ConstraintsToPolyData(this->Solution.Constraints, this->Scene,
                              this->Kept<vtkPolyData>(ConstraintsPort));
  waft::RoundsToTable(this->Solution.Rounds, this->Scene, this->Kept<vtkTable>(RoundsPort));
}

waft::Result vtkAirAssimilationFilter::Internals::PublishFrom(vtkInformationVector** inputs)
{
  this->Kept<vtkPolyData>(TracksPort)->ShallowCopy(vtkPolyData::GetData(inputs[PlannedPort]));
  this->Kept<vtkPolyData>(ConstraintsPort)->ShallowCopy(vtkPolyData::GetData(inputs[RowsPort]));
  return waft::Result::Ok();
}

void vtkAirAssimilationFilter::Internals::FillVarying(double time,
                                                      vtkInformationVector* outputs) const
{
  waft::AirToImage(this->Solution.Air->Velocity, this->Solution.Air->Wind, time, this->Scene,
                   vtkImageData::GetData(outputs, AirPort));
}

vtkAirAssimilationFilter::vtkAirAssimilationFilter() :
  vtkChainStageAlgorithm(waft::ChainStage::Assimilation), Impl(std::make_unique<Internals>(this))
{
  waft::TakeDefaults<waft::AssimilationOptions, waft::TurningOptions>(*this);
}

vtkAirAssimilationFilter::~vtkAirAssimilationFilter() = default;

double vtkAirAssimilationFilter::InRange(const char* property, double value)
{
  return waft::InRange<waft::AssimilationOptions, waft::TurningOptions>(property, value);
}

waft::KeptStage& vtkAirAssimilationFilter::Kept()
{
  return *this->Impl;
}

void vtkAirAssimilationFilter::Restart()
{
  this->Impl->Memory = waft::AssimilationState();
  this->Modified();
}

std::vector<waft::PropertyRange> vtkAirAssimilationFilter::Ranges() const
{
  return waft::RangesOf<waft::AssimilationOptions, waft::TurningOptions>(*this);
}

int vtkAirAssimilationFilter::RequestInformation(vtkInformation*, vtkInformationVector** inputs,
                                                 vtkInformationVector* outputs)
{
  waft::PassTimeSteps(this, inputs, outputs);
  waft::SceneInfo info;
  std::set<std::string> lacking;
  (void)waft::SceneOfInputs(this, inputs, PlannedPort, info, lacking);
  const std::array<int, 3> n =
    waft::AirLatticeDimensions(info.Bounds, waft::OptionsOf<waft::AssimilationOptions>(*this));
  const int extent[6] = { 0, n[0] - 1, 0, n[1] - 1, 0, n[2] - 1 };
  outputs->GetInformationObject(AirPort)->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(),
                                              extent, 6);
  return 1;
}

void vtkAirAssimilationFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::AssimilationOptions, waft::TurningOptions>(os, indent, *this);
}
