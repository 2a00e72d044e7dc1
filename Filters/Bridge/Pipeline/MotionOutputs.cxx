// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Pipeline/MotionOutputs.h"

#include "Bridge/Data/AirData.h"
#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Arrays.h"
#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/FieldCollectors.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/SpacetimeData.h"
#include "Bridge/Data/TrackData.h"
#include "Bridge/Data/TreeData.h"
#include "Bridge/Data/VortexData.h"
#include "Planning/PlanReport.h"

#include <vtkCellData.h>
#include <vtkImageData.h>
#include <vtkInformationVector.h>
#include <vtkPolyData.h>
#include <vtkTable.h>

#include <algorithm>
#include <map>

namespace waft
{

Result MotionOutputs::KeepMotion()
{
  this->KeepPaths();
  WAFT_RETURN_IF_FAILED(this->KeepPoses());
  if (this->Made.Efforts.count(ChainStage::VortexFit) > 0 || !this->Made.Fit.Vortices.empty())
  {
    AirVortexFitToPolyData(this->Made.Fit, this->Scene,
                           this->Kept<vtkPolyData>(FittedVorticesPort));
  }
  return Result::Ok();
}

void MotionOutputs::Clear()
{
  this->Made = Motion();
  this->ShownTracks.clear();
  this->ShownTracks.shrink_to_fit();
  this->ShownPoses.clear();
  this->ShownPoses.shrink_to_fit();
}

void MotionOutputs::KeepPaths()
{
  this->KeepScene();
  this->KeepPlan();
  this->KeepAir();
  this->KeepOptimised();
}

void MotionOutputs::KeepScene()
{
  auto* objects = this->Kept<vtkPolyData>(ObjectsPort);
  ObjectsToPolyData(this->Read().Objects, this->Scene, objects);
  AddArrivals(this->Made.Rows(), this->Made.Tracks, objects);
  AuthoredToFieldData(this->Read().Authored.Objects, objects);
  auto* obstacles = this->Kept<vtkPolyData>(ObstaclesPort);
  ObstaclesToPolyData(this->Read().Obstacles, 0.0, this->Scene, obstacles);
  AuthoredToFieldData(this->Read().Authored.Obstacles, obstacles);
}

void MotionOutputs::KeepPlan()
{
  const PlanOutput& plan = this->Made.Plan;
  if (plan.Tracks.empty())
  {
    return;
  }
  std::vector<Constraint> marks = plan.Constraints;
  TakeStatuses(this->Made.Report, marks);
  auto* rows = this->Kept<vtkPolyData>(MarksPort);
  ConstraintsToPolyData(marks, this->Scene, rows);
  AddLandings(marks, this->Read().Objects,
              this->Made.Tracks.empty() ? this->Made.Paths() : this->Made.Tracks, rows);
  TracksToPolyData(plan.Tracks, this->Scene, this->Kept<vtkPolyData>(PlannedTracksPort));
  TreesToPolyData(plan.Trees, this->Scene, this->Kept<vtkPolyData>(TreesPort));
  ReportToTable(plan.Report, this->Scene, this->Kept<vtkTable>(PlannedReportPort));
}

void MotionOutputs::KeepAir()
{
  const AssimilationOutput& air = this->Made.Air;
  if (air.Tracks.empty())
  {
    return;
  }
  auto* tracks = this->Kept<vtkPolyData>(AssimilatedTracksPort);
  TracksToPolyData(air.Tracks, this->Scene, tracks);
  RoundsToTable(air.Rounds, this->Scene, this->Kept<vtkTable>(RoundsPort));
  if (!air.Controls.empty()) // it has come to its end
  {
    AddControls(air, tracks);
    AddRowTimes(air.Constraints, tracks);
    VorticesToPolyData(air.Vortices, this->Scene, this->Kept<vtkPolyData>(VorticesPort));
    ReportToTable(air.Report, this->Scene, this->Kept<vtkTable>(AssimilatedReportPort));
  }
}

void MotionOutputs::KeepOptimised()
{
  const SpacetimeOutput& optimised = this->Made.Optimised;
  if (optimised.Tracks.empty())
  {
    return;
  }
  auto* tracks = this->Kept<vtkPolyData>(OptimisedTracksPort);
  OptimisedToPolyData(optimised, this->Scene, tracks);
  ConvergenceToTable(optimised.Convergence, this->Scene, this->Kept<vtkTable>(ConvergencePort));
  if (!optimised.Particles.Frames.empty()) // likewise
  {
    AddRowTimes(this->Made.Rows(), tracks);
    ReportToTable(optimised.Report, this->Scene, this->Kept<vtkTable>(OptimisedReportPort));
  }
}

Result MotionOutputs::KeepPoses()
{
  this->ShownTracks.clear();
  this->ShownPoses.clear();
  if (this->Made.Tracks.empty())
  {
    return Result::Ok();
  }
  this->ShownTracks = this->Made.Tracks;
  this->ShownPoses = this->Made.Turned.Poses;
  this->KeepTurned();
  AddDoubles(this->Kept<vtkPolyData>(PosesPort)->GetCellData(), names::Shift, this->Made.Laid);
  AddTurning(this->Made.Turned, this->Kept<vtkPolyData>(PosesPort));
  AddRowTimes(this->Made.RowsAtLast(), this->Kept<vtkPolyData>(PosesPort));
  ReportToTable(this->Made.Turned.Report, this->Scene, this->Kept<vtkTable>(TurnedReportPort));
  return this->BuildMeshes();
}

void MotionOutputs::KeepTurned()
{
  PosesToPolyData(this->ShownTracks, this->ShownPoses, this->Scene,
                  this->Kept<vtkPolyData>(PosesPort));
}

Result MotionOutputs::BuildMeshes()
{
  std::vector<std::vector<std::array<double, 3>>> colors;
  for (const Shape& shape : this->Read().Shapes)
  {
    colors.push_back(this->ColorsOf(shape));
  }
  WAFT_RETURN_IF_FAILED(this->Meshes.Build(this->Read().Shapes, colors, this->Read().Objects,
                                           this->ShownTracks, this->Scene));
  this->Meshes.SetSettled(SettledFrames(this->Made.RowsAtLast(), this->ShownTracks));
  this->Meshes.SetGround(this->Read().Obstacles, this->Scene.Bounds);
  return Result::Ok();
}

void MotionOutputs::StandAsBegun(std::vector<Track> tracks)
{
  std::map<int, const MotionObject*> objects;
  for (const MotionObject& object : this->Read().Objects)
  {
    objects[object.ObjectId] = &object;
  }
  this->ShownTracks = std::move(tracks);
  this->ShownPoses = this->Made.Turned.Poses; // of the first tracks
  for (std::size_t i = this->ShownPoses.size(); i < this->ShownTracks.size(); ++i)
  {
    const Track& track = this->ShownTracks[i];
    PoseTrack still;
    still.ObjectId = track.ObjectId;
    still.Orientations.assign(track.Positions.size(), objects[track.ObjectId]->Orientation);
    still.AngularVelocities.assign(track.Positions.size(), Vec3::Zero());
    still.Torques.assign(track.Positions.size(), Vec3::Zero());
    this->ShownPoses.push_back(std::move(still));
  }
}

void MotionOutputs::Publish()
{
  this->KeepScene();
  if (!this->Wants(ChainStage::Planner))
  {
    return;
  }
  std::vector<Track> tracks = this->Made.Paths();
  if (this->Made.Plan.Tracks.size() < this->Read().Objects.size()) // they are being planned
  {
    tracks = TracksSoFar(tracks, this->Read().Objects, this->Scene.Time);
    TracksToPolyData(tracks, this->Scene, this->Kept<vtkPolyData>(PlannedTracksPort));
    ConstraintsToPolyData(this->Made.Plan.Constraints, this->Scene,
                          this->Kept<vtkPolyData>(MarksPort));
  }
  else
  {
    this->KeepPlan();
  }
  this->KeepAir();
  this->KeepOptimised();
  if (this->Wants(ChainStage::Rotation))
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
void MotionOutputs::KeepBeforeFailure()
{
  this->KeepPaths();
}

void MotionOutputs::FillMeshes(double time, vtkInformationVector* outputs) const
{
  if (!this->ShownTracks.empty())
  {
    this->Meshes.Fill(this->ShownTracks, this->ShownPoses, this->FrameAt(time),
                      vtkPolyData::GetData(outputs, MeshesPort));
  }
  if (std::any_of(this->Read().Obstacles.begin(), this->Read().Obstacles.end(),
                  [](const ObstacleMesh& obstacle) { return obstacle.IsMoving(); }))
  {
    MoveObstacles(this->Read().Obstacles, time * this->Scene.Time.FramesPerSecond,
                  vtkPolyData::GetData(outputs, ObstaclesPort));
  }
}

void MotionOutputs::FillPublished(double time, vtkInformationVector* outputs) const
{
  this->FillMeshes(time, outputs);
}

void MotionOutputs::FillVarying(double time, vtkInformationVector* outputs) const
{
  this->FillMeshes(time, outputs);
  const SampledAir& air = *this->Made.Air.Air;
  if (!air.Velocity.IsEmpty())
  {
    AirToImage(air.Velocity, air.Wind, time, this->Scene, vtkImageData::GetData(outputs, AirPort));
  }
  const SpacetimeOutput& optimised = this->Made.Optimised;
  if (!optimised.Particles.Frames.empty())
  {
    ParticlesToPolyData(optimised.Particles, this->FrameAt(time), this->Scene,
                        vtkPolyData::GetData(outputs, GasPort));
    FieldSeriesToImage(optimised.Wind, time, this->Scene, vtkImageData::GetData(outputs, WindPort));
  }
}

} // namespace waft
