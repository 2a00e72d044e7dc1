// SPDX-License-Identifier: BSD-3-Clause
#include "vtkRotationRefineFilter.h"

#include "Bridge/Data/ArrayNames.h"
#include "Bridge/Data/Arrays.h"
#include "Bridge/Data/ConstraintData.h"
#include "Bridge/Data/PoseData.h"
#include "Bridge/Data/SceneData.h"
#include "Bridge/Data/ShapeData.h"
#include "Bridge/Data/SharedArrays.h"
#include "Bridge/Data/TrackData.h"
#include "Bridge/Files/ShapeColors.h"
#include "Bridge/Pipeline/KeptStage.h"
#include "Bridge/Pipeline/Ranks.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Pipeline/StageInputs.h"
#include "Bridge/Pipeline/StageOptions.h"
#include "Chain/Motion.h"
#include "Rotation/RotationRefine.h"
#include "Scene/Scene.h"

#include <vtkCellData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkMultiProcessController.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTable.h>

#include <algorithm>
#include <map>
#include <utility>

vtkStandardNewMacro(vtkRotationRefineFilter);

namespace
{

enum InputPort
{
  TracksPort,
  ObjectsPort,
  ShapesPort,
  ObstaclesPort,
  WindPort,
  ConstraintsPort,
  AirPort,
};

enum OutputPort
{
  MeshesPort,
  PosesPort,
  ReportPort,
};

} // namespace

struct vtkRotationRefineFilter::Internals : waft::KeptStage
{
  vtkRotationRefineFilter* Self;
  std::vector<waft::Track> Tracks;
  vtkNew<vtkPointData> Left; // of the points of Tracks: what turning does not need
  waft::AirOnTracks Air;
  waft::RotationOutput Rotation;
  waft::PosedMeshes Meshes;
  std::vector<std::vector<std::array<double, 3>>> Colors; // by shape, of its points
  std::vector<vtkMTimeType> ColoredShapes;                // that they are of
  waft::RotationInput Input;
  std::vector<waft::PoseTrack> PublishedPoses; // of Input

  explicit Internals(vtkRotationRefineFilter* self) :
    KeptStage(self, TracksPort, ObstaclesPort, WindPort, AirPort), Self(self)
  {
  }
  ~Internals() override { this->Discard(); }
  waft::Result TakePass(vtkInformationVector** inputs, bool isFirst) override;
  waft::Result Take(vtkInformationVector** inputs, waft::RotationInput& input);
  waft::Result Adopt(vtkInformationVector** inputs, const waft::Scene& scene,
                     const waft::Motion& motion) override;
  void KeepPoses(const std::vector<double>& farthest, vtkPointData* given);
  void KeepWhatMeshesNeed();
  waft::Result BuildMeshes(vtkInformationVector** inputs, const waft::RotationInput& input);
  waft::Result Run(vtkInformationVector** inputs, waft::Monitor& monitor) override;
  double Slice() const override { return this->Self->Slice; }
  void Publish() override;
  waft::Result PublishFrom(vtkInformationVector** inputs) override;
  void FillPublished(double time, vtkInformationVector* outputs) const override;
  bool IsActive() const override { return this->Self->Active; }
  void Clear() override
  {
    this->Tracks.clear();
    this->Left->Initialize();
    this->Air = waft::AirOnTracks();
    this->Rotation = waft::RotationOutput();
    this->Input = waft::RotationInput();
    this->PublishedPoses.clear();
  }
  void FillVarying(double time, vtkInformationVector* outputs) const override;
};

waft::Result vtkRotationRefineFilter::Internals::TakePass(vtkInformationVector** inputs,
                                                          bool isFirst)
{
  if (isFirst)
  {
    WAFT_RETURN_IF_FAILED(waft::FlightsFromPolyData(vtkPolyData::GetData(inputs[TracksPort]),
                                                    this->Tracks, this->Left));
    this->Air = waft::AirOnTracks(this->Tracks, this->Scene.Time);
  }
  return this->Air.Add(this->Fields.TakeAir());
}

waft::Result vtkRotationRefineFilter::Internals::Take(vtkInformationVector** inputs,
                                                      waft::RotationInput& input)
{
  input.Scene = this->Scene;
  input.Tracks = std::move(this->Tracks);
  WAFT_RETURN_IF_FAILED(
    waft::ObjectsFromPolyData(vtkPolyData::GetData(inputs[ObjectsPort]), input.Objects));
  WAFT_RETURN_IF_FAILED(
    waft::BodiesFromMultiBlock(vtkMultiBlockDataSet::GetData(inputs[ShapesPort]), input.Shapes));
  return this->TakeConstraints(inputs[ConstraintsPort], input.Constraints);
}

waft::Result vtkRotationRefineFilter::Internals::BuildMeshes(vtkInformationVector** inputs,
                                                             const waft::RotationInput& input)
{
  // Textures are read once, and not with each slice that the plan has come to.
  const std::vector<vtkMTimeType> shapes = waft::InputSignature(inputs[ShapesPort]);
  if (this->ColoredShapes != shapes || this->Colors.size() != input.Shapes.size())
  {
    this->ColoredShapes = shapes;
    this->Colors.clear();
    for (const waft::Shape& shape : input.Shapes)
    {
      this->Colors.push_back(waft::ColorsOfPoints(shape));
    }
  }
  WAFT_RETURN_IF_FAILED(
    this->Meshes.Build(input.Shapes, this->Colors, input.Objects, input.Tracks, this->Scene));
  this->Meshes.SetSettled(waft::SettledFrames(input.Constraints, input.Tracks));
  if (input.Obstacles != nullptr)
  {
    this->Meshes.SetGround(input.Obstacles->Obstacles(), this->Scene.Bounds);
  }
  return waft::Result::Ok();
}

waft::Result vtkRotationRefineFilter::Internals::Run(vtkInformationVector** inputs,
                                                     waft::Monitor& monitor)
{
  waft::RotationInput& input = this->Input;
  input = waft::RotationInput();
  vtkNew<vtkPointData> given; // the inputs are those of the request in which the run begins
  given->ShallowCopy(vtkPolyData::GetData(inputs[TracksPort])->GetPointData());
  this->Rotation = waft::RotationOutput();
  this->Air.Finish();
  waft::AirOnTracks air = std::move(this->Air);
  input.Air = &air;
  WAFT_RETURN_IF_FAILED(this->Take(inputs, input));
  waft::ObstacleSet obstacles;
  WAFT_RETURN_IF_FAILED(obstacles.Build(this->Fields.TakeObstacles()));
  input.Obstacles = &obstacles;
  const waft::FieldSeries wind = this->Fields.TakeWind();
  input.Wind = &wind;
  waft::ControllerCommunicator ranks(this->Self->Controller);
  input.Ranks = &ranks;
  WAFT_RETURN_IF_FAILED(this->BuildMeshes(inputs, input));
  const waft::Result result =
    waft::RunRotationRefine(input, waft::OptionsOf<waft::RotationOptions>(*this->Self),
                            waft::SmpFor(), monitor, this->Rotation);
  input.Air = nullptr;
  air = waft::AirOnTracks(); // of many bodies it is as large as what they do
  this->Rejoin();
  if (result && !result.IsStopped()) // half of the poses are of no use
  {
    this->Tracks = std::move(input.Tracks);
    const std::vector<double> farthest = waft::ApplyShifts(this->Rotation, this->Tracks);
    this->Warnings = this->Rotation.Warnings;
    this->KeepPoses(farthest, given);
  }
  input = waft::RotationInput(); // it points to what ends here
  return result;
}

waft::Result vtkRotationRefineFilter::Internals::Adopt(vtkInformationVector** inputs,
                                                       const waft::Scene& scene,
                                                       const waft::Motion& motion)
{
  waft::RotationInput input;
  input.Objects = scene.Objects;
  input.Shapes = scene.Shapes;
  input.Tracks = motion.Tracks;
  WAFT_RETURN_IF_FAILED(this->BuildMeshes(inputs, input));
  this->Meshes.SetGround(scene.Obstacles, this->Scene.Bounds);
  this->Tracks = motion.Tracks;
  this->Rotation = motion.Turned;
  this->Left->Initialize();
  this->KeepPoses(motion.Laid, vtkPolyData::GetData(inputs[TracksPort])->GetPointData());
  return waft::Result::Ok();
}

void vtkRotationRefineFilter::Internals::KeepPoses(const std::vector<double>& farthest,
                                                   vtkPointData* given)
{
  waft::PosesToPolyData(this->Tracks, this->Rotation.Poses, this->Scene,
                        this->Kept<vtkPolyData>(PosesPort), this->Left);
  this->Left->Initialize();
  waft::ShareEqualArrays(given, this->Kept<vtkPolyData>(PosesPort)->GetPointData());
  waft::AddDoubles(this->Kept<vtkPolyData>(PosesPort)->GetCellData(), waft::names::Shift, farthest);
  waft::AddTurning(this->Rotation, this->Kept<vtkPolyData>(PosesPort));
  waft::AddRowTimes(this->Rotation.Constraints, this->Kept<vtkPolyData>(PosesPort));
  this->Meshes.SetSettled(waft::SettledFrames(this->Rotation.Constraints, this->Tracks));
  waft::ReportToTable(this->Rotation.Report, this->Scene, this->Kept<vtkTable>(ReportPort));
  this->KeepWhatMeshesNeed();
}

// The outputs have the rest, and bodies may be many.
void vtkRotationRefineFilter::Internals::KeepWhatMeshesNeed()
{
  for (waft::Track& track : this->Tracks)
  {
    waft::Track path;
    path.ObjectId = track.ObjectId;
    path.FirstPresent = track.FirstPresent;
    path.Leave = track.Leave;
    path.Fade = track.Fade;
    path.Positions = std::move(track.Positions);
    track = std::move(path);
  }
  waft::RotationOutput kept;
  for (waft::PoseTrack& turned : this->Rotation.Poses)
  {
    kept.Poses.emplace_back();
    kept.Poses.back().ObjectId = turned.ObjectId;
    kept.Poses.back().Orientations = std::move(turned.Orientations);
  }
  this->Rotation = std::move(kept);
}

// Those that are not turned yet keep the orientation that they begin with.
void vtkRotationRefineFilter::Internals::Publish()
{
  std::map<int, waft::Quat> begun;
  for (const waft::MotionObject& object : this->Input.Objects)
  {
    begun[object.ObjectId] = object.Orientation;
  }
  this->PublishedPoses = this->Rotation.Poses;
  for (std::size_t i = this->PublishedPoses.size(); i < this->Input.Tracks.size(); ++i)
  {
    const waft::Track& track = this->Input.Tracks[i];
    waft::PoseTrack still;
    still.ObjectId = track.ObjectId;
    still.Orientations.assign(track.Positions.size(), begun[track.ObjectId]);
    still.AngularVelocities.assign(track.Positions.size(), waft::Vec3::Zero());
    still.Torques.assign(track.Positions.size(), waft::Vec3::Zero());
    this->PublishedPoses.push_back(std::move(still));
  }
  waft::PosesToPolyData(this->Input.Tracks, this->PublishedPoses, this->Scene,
                        this->Kept<vtkPolyData>(PosesPort), this->Left);
}

waft::Result vtkRotationRefineFilter::Internals::PublishFrom(vtkInformationVector** inputs)
{
  this->Input = waft::RotationInput();
  this->Rotation = waft::RotationOutput();
  this->PublishedPoses.clear();
  WAFT_RETURN_IF_FAILED(
    waft::FlightsFromPolyData(vtkPolyData::GetData(inputs[TracksPort]), this->Tracks, this->Left));
  WAFT_RETURN_IF_FAILED(this->Take(inputs, this->Input));
  WAFT_RETURN_IF_FAILED(this->BuildMeshes(inputs, this->Input));
  this->Publish();
  return waft::Result::Ok();
}

void vtkRotationRefineFilter::Internals::FillPublished(double time,
                                                       vtkInformationVector* outputs) const
{
  if (!this->PublishedPoses.empty())
  {
    this->Meshes.Fill(this->Input.Tracks, this->PublishedPoses, this->FrameAt(time),
                      vtkPolyData::GetData(outputs, MeshesPort));
  }
}

void vtkRotationRefineFilter::Internals::FillVarying(double time,
                                                     vtkInformationVector* outputs) const
{
  if (!this->Tracks.empty())
  {
    this->Meshes.Fill(this->Tracks, this->Rotation.Poses, this->FrameAt(time),
                      vtkPolyData::GetData(outputs, MeshesPort));
  }
}

vtkRotationRefineFilter::vtkRotationRefineFilter() :
  vtkChainStageAlgorithm(waft::ChainStage::Rotation), Impl(std::make_unique<Internals>(this))
{
  waft::TakeDefaults<waft::RotationOptions>(*this);
}

vtkRotationRefineFilter::~vtkRotationRefineFilter() = default;

double vtkRotationRefineFilter::InRange(const char* property, double value)
{
  return waft::InRange<waft::RotationOptions>(property, value);
}

waft::KeptStage& vtkRotationRefineFilter::Kept()
{
  return *this->Impl;
}

std::vector<waft::PropertyRange> vtkRotationRefineFilter::Ranges() const
{
  return waft::RangesOf<waft::RotationOptions>(*this);
}

void vtkRotationRefineFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  waft::PrintFields<waft::RotationOptions>(os, indent, *this);
}
