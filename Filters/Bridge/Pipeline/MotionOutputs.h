// SPDX-License-Identifier: BSD-3-Clause
// A motion that the chain makes, as the outputs of one source: by port, whole or as far as it has
// come.
#pragma once

#include "Bridge/Data/PoseData.h"
#include "Bridge/Pipeline/KeptStage.h"
#include "Chain/Motion.h"
#include "Scene/Scene.h"

#include <array>
#include <functional>
#include <utility>
#include <vector>

namespace waft
{

/// By port, as MotionPorts has them.
enum MotionPort
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
  NumberOfMotionPorts
};

/// A stage whose outputs they are. Who derives runs the chain, into Made.
class MotionOutputs : public KeptStage
{
public:
  /// What a shape looks like: the colour of each of its points.
  using Colors = std::function<std::vector<std::array<double, 3>>(const Shape&)>;

  MotionOutputs(vtkAlgorithm* stage, Colors colors) :
    KeptStage(stage, FieldSweep::NoPort), ColorsOf(std::move(colors))
  {
  }

  /// The scene that is flown.
  virtual const waft::Scene& Read() const = 0;
  /// Whether the chain comes to a stage, as it is asked for.
  virtual bool Wants(ChainStage stage) const = 0;

protected:
  /// Fills the Kept outputs with what is in Made. Fails where meshes cannot stand on their poses.
  Result KeepMotion();

  void Publish() override;
  void KeepBeforeFailure() override;
  void Clear() override;
  void FillVarying(double time, vtkInformationVector* outputs) const override;
  void FillPublished(double time, vtkInformationVector* outputs) const override;

  Motion Made;

private:
  void KeepPaths(); // of the scene, and of each stage that moves bodies
  void KeepScene();
  void KeepPlan();
  void KeepAir();
  void KeepOptimised();
  Result KeepPoses();
  void KeepTurned();
  /// Poses of those that are not turned yet: as they begin.
  void StandAsBegun(std::vector<Track> tracks);
  Result BuildMeshes();
  void FillMeshes(double time, vtkInformationVector* outputs) const;

  Colors ColorsOf;
  PosedMeshes Meshes;
  std::vector<Track> ShownTracks; // that the meshes stand on
  std::vector<PoseTrack> ShownPoses;
};

} // namespace waft
