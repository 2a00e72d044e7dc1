// SPDX-License-Identifier: BSD-3-Clause
// Shi et al. 2005, section 6: how each object turns while its centre follows a given path.
#pragma once

#include "Base/FieldSeries.h"
#include "Base/Monitor.h"
#include "Base/Motion.h"
#include "Base/Parallel.h"
#include "Base/Pose.h"
#include "Base/Result.h"
#include "Base/Shape.h"
#include "Constraints/Constraint.h"
#include "Obstacles/ObstacleSet.h"
#include "Rotation/PanelBody.h"

#include <string>
#include <vector>

namespace waft
{

struct RotationOptions
{
  AirModel Model = AirModel::Plate;
  double Damping = 0.3;       // 1/s, of the angular momentum; 0 or more
  double Lift = 2.9;          // extra slope of the normal force at small angles of attack, 0..4
  double PressureShift = 0.0; // half chords, 0..1
  double Roll = 1.0;          // 0..4: share of the drive that keeps a turning plate turning over
  double Spin = 0.0;          // rad, -1..1: pitch as of a propeller, about the normal
  double Follow = 0.5;        // 1/s: how fast the hidden sideslip is forgotten; 0 or more
  double VariationPerObject = 0.15; // 0..0.5: how much objects of one shape differ, by Seed
  double LandingTime = 0.7;         // s in which a body settles before it rests
  double TurningTime = 2.0;         // s, at most, over which an orientation row draws the pose
  double TurningRate = 60.0; // rad/s, 1..1000: rows that ask for more are met by halves and named
  int RasterSize = 128;      // pixels, 8..1024
  std::uint64_t Seed = 1;

  Result Validate() const;
};

struct RotationInput
{
  SceneInfo Scene;
  std::vector<MotionObject> Objects;
  std::vector<Track> Tracks; // all of one length, one for each object, any order
  std::vector<Shape> Shapes; // by ShapeId
  std::vector<Constraint> Constraints;
  const ObstacleSet* Obstacles = nullptr; // or none
  /// The air's velocity where tracks carry none; its gradient counts in any case. A field of
  /// accelerations is passed over: it has acted on the path already.
  const FieldSeries* Wind = nullptr;
};

struct RotationOutput
{
  std::vector<PoseTrack> Poses; // in the order of Tracks
  /// m, by which centres are moved so that meshes touch surfaces and do not cut them: in the order
  /// of Tracks, one a frame, or empty for a track that stays; at most 1e-3 of the volume's width.
  std::vector<std::vector<Vec3>> Shifts;
  /// One line for each orientation row: judged by itself, then measured on the poses, with the
  /// reason where the greatest turning rate does not do.
  std::vector<ReportRow> Report;
  std::vector<std::string> Warnings; // objects and shapes are named; rows that are not met too
};

/// Fails when a shape has no area, a mass is not positive, a track has no object or another length;
/// nothing is written then. Results do not depend on the number of threads.
Result RunRotationRefine(const RotationInput& input, const RotationOptions& options,
                         const ParallelFor& parallel, Monitor& monitor, RotationOutput& output);

} // namespace waft
