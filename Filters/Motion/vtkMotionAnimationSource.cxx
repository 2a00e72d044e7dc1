// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMotionAnimationSource.h"

#include "Base/SliceOptions.h"
#include "Bridge/Data/AirData.h"
#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Arrays.h"
#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/PoseData.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/SpacetimeData.h"
#include "Bridge/Data/TrackData.h"
#include "Bridge/Data/TreeData.h"
#include "Bridge/Data/VortexData.h"
#include "Bridge/Files/EmbeddedDatabase.h"
#include "Bridge/Files/SceneFiles.h"
#include "Bridge/Files/ShapeColors.h"
#include "Bridge/Pipeline/KeptStage.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Chain/EditedScene.h"
#include "Chain/RunChain.h"
#include "Planning/PlanReport.h"
#include "Spacetime/Run/Spacetime.h"

#include <vtkCellData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkTable.h>
#include <vtkTimeStamp.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

vtkStandardNewMacro(vtkMotionAnimationSource);

namespace
{

enum OutputPort
{
  MeshesPort,
  PosesPort,
  ObstaclesPort,
  ObjectsPort,
  MarksPort,
  PlannedTracksPort,
  TreesPort,
  PlannedReportPort,
  AssimilatedTracksPort,
  AirPort,
  VorticesPort,
  AssimilatedReportPort,
  RoundsPort,
  OptimisedTracksPort,
  GasPort,
  WindPort,
  ConvergencePort,
  OptimisedReportPort,
  TurnedReportPort,
  FittedVorticesPort,
  NumberOfOutputs
};

bool IsTable(int port)
{
  return port == PlannedReportPort || port == AssimilatedReportPort || port == RoundsPort ||
         port == ConvergencePort || port == OptimisedReportPort || port == TurnedReportPort;
}

} // namespace

struct vtkMotionAnimationSource::Internals : waft::KeptStage
{
  vtkMotionAnimationSource* Self;
  vtkTimeStamp Named, ReadTime; // when the file was named, or to be read anew; and read
  waft::EditedScene File;
  waft::MotionDatabase Database; // stays in its place, where the memory's tools look for it
  bool HasDatabase = false;
  waft::Motion Made;
  waft::ChainMemory Memory;
  waft::PosedMeshes Meshes;
  std::vector<waft::Track> ShownTracks; // that the meshes stand on
  std::vector<waft::PoseTrack> ShownPoses;

  explicit Internals(vtkMotionAnimationSource* self) :
    KeptStage(self, waft::FieldSweep::NoPort), Self(self)
  {
  }
  ~Internals() override { this->Discard(); }

  bool IsRead() const { return this->ReadTime > this->Named; }
  bool Load();
  const waft::Scene& Read() const { return this->File.Parts(); }
  waft::ChainOptions Options() const;
  bool Wants(waft::ChainStage stage) const;
  waft::Result Run(vtkInformationVector** inputs, waft::Monitor& monitor) override;
  double Slice() const override { return this->Self->Slice; }
  void Publish() override;
  void KeepBeforeFailure() override;
  void FillVarying(double time, vtkInformationVector* outputs) const override;
  void FillPublished(double time, vtkInformationVector* outputs) const override;

private:
  void KeepScene();
  void KeepPlan();
  void KeepAir();
  void KeepOptimised();
  waft::Result KeepPoses();
  void KeepTurned();
  /// Poses of those that are not turned yet: as they begin.
  void StandAsBegun(std::vector<waft::Track> tracks);
  waft::Result BuildMeshes();
  void FillMeshes(double time, vtkInformationVector* outputs) const;
};

/// True where the file was read now.
bool vtkMotionAnimationSource::Internals::Load()
{
  if (this->IsRead())
  {
    return false;
  }
  this->Discard(); // it works on the scene that there was
  this->File.Read(this->Self->FileName, this->Self->Edits, waft::VtkSceneAssets());
  this->Scene = this->Read().Info;
  this->ReadTime.Modified();
  return true;
}

waft::ChainOptions vtkMotionAnimationSource::Internals::Options() const
{
  waft::ChainOptions options =
    waft::ChainOptions::At(static_cast<waft::Quality>(this->Self->Quality));
  options.Seed = this->Self->Seed;
  options.StopAfter = static_cast<waft::ChainStage>(this->Self->StopAfter);
  options.Takes = waft::OptionsOf<waft::TakeOptions>(*this->Self);
  return options;
}

bool vtkMotionAnimationSource::Internals::Wants(waft::ChainStage stage) const
{
  return this->Self->RangeError().empty() && static_cast<int>(stage) <= this->Self->StopAfter &&
         waft::RunsAt(stage, static_cast<waft::Quality>(this->Self->Quality));
}

waft::Result vtkMotionAnimationSource::Internals::Run(vtkInformationVector**,
                                                      waft::Monitor& monitor)
{
  if (this->Read().Objects.empty())
  {
    return waft::Result::Error(this->Self->FileName +
                               ": /objects: expected at least one object, found none");
  }
  if (!this->HasDatabase && this->Wants(waft::ChainStage::Planner))
  {
    WAFT_RETURN_IF_FAILED(waft::ReadEmbeddedDatabase(this->Database));
    this->HasDatabase = true;
  }
  const waft::Result result =
    waft::RunChain({ this->Read(), this->File.Wind(), this->Database }, this->Options(),
                   waft::SmpFor(), monitor, this->Made, &this->Memory);
  this->Rejoin();
  WAFT_RETURN_IF_FAILED(result);
  for (const auto& [stage, seconds] : this->Made.Seconds) // what was kept has warned already
  {
    const std::vector<std::string>& warnings = this->Made.Warnings[stage];
    this->Warnings.insert(this->Warnings.end(), warnings.begin(), warnings.end());
  }
  this->KeepScene();
  this->KeepPlan();
  this->KeepAir();
  this->KeepOptimised();
  WAFT_RETURN_IF_FAILED(this->KeepPoses());
  if (this->Made.Seconds.count(waft::ChainStage::VortexFit) > 0 || !this->Made.Fit.Vortices.empty())
  {
    waft::AirVortexFitToPolyData(this->Made.Fit, this->Scene,
                                 this->Kept<vtkPolyData>(FittedVorticesPort));
  }
  return result;
}

void vtkMotionAnimationSource::Internals::KeepScene()
{
  auto* objects = this->Kept<vtkPolyData>(ObjectsPort);
  waft::ObjectsToPolyData(this->Read().Objects, this->Scene, objects);
  waft::AuthoredToFieldData(this->Read().Authored.Objects, objects);
  auto* obstacles = this->Kept<vtkPolyData>(ObstaclesPort);
  waft::ObstaclesToPolyData(this->Read().Obstacles, 0.0, this->Scene, obstacles);
  waft::AuthoredToFieldData(this->Read().Authored.Obstacles, obstacles);
}

void vtkMotionAnimationSource::Internals::KeepPlan()
{
  const waft::PlanOutput& plan = this->Made.Plan;
  if (plan.Tracks.empty())
  {
    return;
  }
  std::vector<waft::Constraint> marks = plan.Constraints;
  waft::TakeStatuses(this->Made.Report, marks);
  waft::ConstraintsToPolyData(marks, this->Scene, this->Kept<vtkPolyData>(MarksPort));
  waft::TracksToPolyData(plan.Tracks, this->Scene, this->Kept<vtkPolyData>(PlannedTracksPort));
  waft::TreesToPolyData(plan.Trees, this->Scene, this->Kept<vtkPolyData>(TreesPort));
  waft::ReportToTable(plan.Report, this->Scene, this->Kept<vtkTable>(PlannedReportPort));
}

void vtkMotionAnimationSource::Internals::KeepAir()
{
  const waft::AssimilationOutput& air = this->Made.Air;
  if (air.Tracks.empty())
  {
    return;
  }
  auto* tracks = this->Kept<vtkPolyData>(AssimilatedTracksPort);
  waft::TracksToPolyData(air.Tracks, this->Scene, tracks);
  waft::RoundsToTable(air.Rounds, this->Scene, this->Kept<vtkTable>(RoundsPort));
  if (!air.Controls.empty()) // it has come to its end
  {
    waft::AddControls(air.Controls, tracks);
    waft::AddTouchDowns(air.Constraints, tracks);
    waft::VorticesToPolyData(air.Vortices, this->Scene, this->Kept<vtkPolyData>(VorticesPort));
    waft::ReportToTable(air.Report, this->Scene, this->Kept<vtkTable>(AssimilatedReportPort));
  }
}

void vtkMotionAnimationSource::Internals::KeepOptimised()
{
  const waft::SpacetimeOutput& optimised = this->Made.Optimised;
  if (optimised.Tracks.empty())
  {
    return;
  }
  auto* tracks = this->Kept<vtkPolyData>(OptimisedTracksPort);
  waft::OptimisedToPolyData(optimised, this->Scene, tracks);
  waft::ConvergenceToTable(optimised.Convergence, this->Scene,
                           this->Kept<vtkTable>(ConvergencePort));
  if (!optimised.Particles.Frames.empty()) // likewise
  {
    waft::AddTouchDowns(this->Made.Rows(), tracks);
    waft::ReportToTable(optimised.Report, this->Scene, this->Kept<vtkTable>(OptimisedReportPort));
  }
}

waft::Result vtkMotionAnimationSource::Internals::KeepPoses()
{
  this->ShownTracks.clear();
  this->ShownPoses.clear();
  if (this->Made.Tracks.empty())
  {
    return waft::Result::Ok();
  }
  this->ShownTracks = this->Made.Tracks;
  this->ShownPoses = this->Made.Turned.Poses;
  this->KeepTurned();
  waft::AddDoubles(this->Kept<vtkPolyData>(PosesPort)->GetCellData(), waft::names::Shift,
                   this->Made.Laid);
  waft::AddAgreement(this->Made.Turned.Away, this->Kept<vtkPolyData>(PosesPort));
  waft::AddBodyFactors(this->Made.Turned.Factors, this->Kept<vtkPolyData>(PosesPort));
  waft::AddTouchDowns(this->Made.RowsAtLast(), this->Kept<vtkPolyData>(PosesPort));
  waft::ReportToTable(this->Made.Turned.Report, this->Scene,
                      this->Kept<vtkTable>(TurnedReportPort));
  return this->BuildMeshes();
}

void vtkMotionAnimationSource::Internals::KeepTurned()
{
  waft::PosesToPolyData(this->ShownTracks, this->ShownPoses, this->Scene,
                        this->Kept<vtkPolyData>(PosesPort));
}

waft::Result vtkMotionAnimationSource::Internals::BuildMeshes()
{
  std::vector<std::vector<std::array<double, 3>>> colors;
  for (const waft::Shape& shape : this->Read().Shapes)
  {
    colors.push_back(waft::ColorsOfPoints(shape));
  }
  return this->Meshes.Build(this->Read().Shapes, colors, this->Read().Objects, this->ShownTracks,
                            this->Scene);
}

void vtkMotionAnimationSource::Internals::StandAsBegun(std::vector<waft::Track> tracks)
{
  std::map<int, const waft::MotionObject*> objects;
  for (const waft::MotionObject& object : this->Read().Objects)
  {
    objects[object.ObjectId] = &object;
  }
  this->ShownTracks = std::move(tracks);
  this->ShownPoses = this->Made.Turned.Poses; // of the first tracks
  for (std::size_t i = this->ShownPoses.size(); i < this->ShownTracks.size(); ++i)
  {
    const waft::Track& track = this->ShownTracks[i];
    waft::PoseTrack still;
    still.ObjectId = track.ObjectId;
    still.Orientations.assign(track.Positions.size(), objects[track.ObjectId]->Orientation);
    still.AngularVelocities.assign(track.Positions.size(), waft::Vec3::Zero());
    still.Torques.assign(track.Positions.size(), waft::Vec3::Zero());
    this->ShownPoses.push_back(std::move(still));
  }
}

void vtkMotionAnimationSource::Internals::Publish()
{
  this->KeepScene();
  if (!this->Wants(waft::ChainStage::Planner))
  {
    return;
  }
  std::vector<waft::Track> tracks = this->Made.Paths();
  if (this->Made.Plan.Tracks.size() < this->Read().Objects.size()) // they are being planned
  {
    tracks = waft::TracksSoFar(tracks, this->Read().Objects, this->Scene.Time);
    waft::TracksToPolyData(tracks, this->Scene, this->Kept<vtkPolyData>(PlannedTracksPort));
    waft::ConstraintsToPolyData(this->Made.Plan.Constraints, this->Scene,
                                this->Kept<vtkPolyData>(MarksPort));
  }
  else
  {
    this->KeepPlan();
  }
  this->KeepAir();
  this->KeepOptimised();
  if (this->Wants(waft::ChainStage::Rotation))
  {
    this->StandAsBegun(std::move(tracks));
    this->KeepTurned();
    if (!this->BuildMeshes())
    {
      this->ShownTracks.clear();
    }
  }
}

// Of the stage that failed, and of those after it, there is nothing.
void vtkMotionAnimationSource::Internals::KeepBeforeFailure()
{
  this->KeepScene();
  this->KeepPlan();
  this->KeepAir();
  this->KeepOptimised();
}

void vtkMotionAnimationSource::Internals::FillMeshes(double time,
                                                     vtkInformationVector* outputs) const
{
  if (!this->ShownTracks.empty())
  {
    this->Meshes.Fill(this->ShownTracks, this->ShownPoses, this->FrameAt(time),
                      vtkPolyData::GetData(outputs, MeshesPort));
  }
  if (std::any_of(this->Read().Obstacles.begin(), this->Read().Obstacles.end(),
                  [](const waft::ObstacleMesh& obstacle) { return obstacle.IsMoving(); }))
  {
    waft::MoveObstacles(this->Read().Obstacles, time * this->Scene.Time.FramesPerSecond,
                        vtkPolyData::GetData(outputs, ObstaclesPort));
  }
}

void vtkMotionAnimationSource::Internals::FillPublished(double time,
                                                        vtkInformationVector* outputs) const
{
  this->FillMeshes(time, outputs);
}

void vtkMotionAnimationSource::Internals::FillVarying(double time,
                                                      vtkInformationVector* outputs) const
{
  this->FillMeshes(time, outputs);
  const waft::SampledAir& air = *this->Made.Air.Air;
  if (!air.Velocity.IsEmpty())
  {
    waft::AirToImage(air.Velocity, air.Wind, time, this->Scene,
                     vtkImageData::GetData(outputs, AirPort));
  }
  const waft::SpacetimeOutput& optimised = this->Made.Optimised;
  if (!optimised.Particles.Frames.empty())
  {
    waft::ParticlesToPolyData(optimised.Particles, this->FrameAt(time), this->Scene,
                              vtkPolyData::GetData(outputs, GasPort));
    waft::FieldSeriesToImage(optimised.Wind, time, this->Scene,
                             vtkImageData::GetData(outputs, WindPort));
  }
}

vtkMotionAnimationSource::vtkMotionAnimationSource() : Impl(std::make_unique<Internals>(this))
{
  waft::TakeDefaults<waft::FlightOptions, waft::TakeOptions>(*this);
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(NumberOfOutputs);
  this->Impl->Named.Modified();
}

vtkMotionAnimationSource::~vtkMotionAnimationSource() = default;

double vtkMotionAnimationSource::InRange(const char* property, double value)
{
  return waft::InRange<waft::FlightOptions, waft::TakeOptions>(property, value);
}

waft::KeptStage& vtkMotionAnimationSource::Kept()
{
  return *this->Impl;
}

void vtkMotionAnimationSource::SetFileName(const std::string& name)
{
  this->FileName = name;
  this->Reload();
}

void vtkMotionAnimationSource::Reload()
{
  this->Impl->Named.Modified();
  this->Modified();
}

void vtkMotionAnimationSource::SetEdits(const std::string& edits)
{
  if (edits != this->Edits)
  {
    this->Edits = edits;
    this->Reload();
  }
}

std::string vtkMotionAnimationSource::GetHandles() const
{
  return this->Impl->File.Handles();
}

void vtkMotionAnimationSource::SaveScene()
{
  const waft::Result result =
    this->Impl->IsRead() ? this->Impl->File.Save()
                         : waft::Result::Error(this->FileName + ": expected a scene that was read, "
                                                                "found none: not saved");
  if (!result)
  {
    vtkErrorMacro(<< result.Message());
    return;
  }
  this->Edits.clear(); // the scene is the one that it was
}

int vtkMotionAnimationSource::GetSceneSeed() const
{
  return static_cast<int>(this->Impl->Read().Info.Seed);
}

std::string vtkMotionAnimationSource::GetStages()
{
  return waft::ChainTableAsJson();
}

std::string vtkMotionAnimationSource::RangeError() const
{
  const auto error =
    [](const char* name, int last, const char* first, const char* lastName, int found)
  {
    return found >= 0 && found <= last
             ? std::string()
             : std::string(name) + ": expected 0 (" + first + ") to " + std::to_string(last) +
                 " (" + lastName + "), found " + std::to_string(found);
  };
  const std::string quality = error("Quality", PAPER, "Preview", "Paper", this->Quality);
  return !quality.empty() ? quality
                          : error("StopAfter", AFTER_ALL, "Scene", "VortexFit", this->StopAfter);
}

int vtkMotionAnimationSource::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), IsTable(port)                         ? "vtkTable"
                                             : port == AirPort || port == WindPort ? "vtkImageData"
                                                                                   : "vtkPolyData");
  return 1;
}

vtkTypeBool vtkMotionAnimationSource::ProcessRequest(vtkInformation* request,
                                                     vtkInformationVector** inputs,
                                                     vtkInformationVector* outputs)
{
  return waft::GuardedRequest(
    this, request, outputs, waft::RangesOf<waft::TakeOptions, waft::SliceOptions>(*this),
    [&] { return this->Superclass::ProcessRequest(request, inputs, outputs); });
}

int vtkMotionAnimationSource::RequestInformation(vtkInformation*, vtkInformationVector**,
                                                 vtkInformationVector* outputs)
{
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    // The pipeline asks the other ranks, of several, for their pieces only then.
    outputs->GetInformationObject(port)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 0);
  }
  if (this->FileName.empty())
  {
    return waft::FailInformation(outputs); // RequestData asks for the name
  }
  if (this->Impl->Load())
  {
    for (const std::string& warning : this->Impl->Read().Warnings)
    {
      vtkWarningMacro(<< warning);
    }
  }
  if (!this->Impl->File.Error().empty())
  {
    return waft::FailInformation(outputs);
  }
  const waft::SceneInfo& info = this->Impl->Read().Info;
  waft::SetTimeSteps(info.Time, outputs);
  const auto setExtent = [&](int port, bool isMade, const std::array<int, 3>& points)
  {
    int extent[6] = { 0, -1, 0, -1, 0, -1 };
    for (std::size_t axis = 0; axis < 3 && isMade; ++axis)
    {
      extent[2 * axis + 1] = points[axis] - 1;
    }
    outputs->GetInformationObject(port)->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(),
                                             extent, 6);
  };
  const bool draws = this->Impl->Wants(waft::ChainStage::Assimilation);
  const bool optimises = this->Impl->Wants(waft::ChainStage::Spacetime);
  setExtent(AirPort, draws,
            draws ? waft::AirLatticeDimensions(info.Bounds, this->Impl->Options().Air)
                  : std::array<int, 3>{ 0, 0, 0 });
  setExtent(WindPort, optimises,
            waft::WindLatticeDimensions(info.Bounds, this->Impl->Options().Optimiser));
  return 1;
}

int vtkMotionAnimationSource::RequestData(vtkInformation* request, vtkInformationVector** inputs,
                                          vtkInformationVector* outputs)
{
  if (this->FileName.empty())
  {
    return waft::Fail(this, outputs, "FileName: expected a scene file, found no name");
  }
  if (!this->Impl->File.Error().empty())
  {
    return waft::Fail(this, outputs, this->Impl->File.Error());
  }
  if (const std::string error = this->RangeError(); !error.empty())
  {
    return waft::Fail(this, outputs, error);
  }
  if (waft::IsPieceOfOthers(request, outputs))
  {
    return waft::Empty(outputs);
  }
  return this->Impl->RequestData(request, inputs, outputs);
}

void vtkMotionAnimationSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::FlightOptions, waft::TakeOptions>(os, indent, *this);
}
