// SPDX-License-Identifier: BSD-3-Clause
// Shi et al. 2005, section 6: how each object turns while its centre follows a given path.
#pragma once

#include "Base/Communicator.h"
#include "Base/FieldSeries.h"
#include "Base/Monitor.h"
#include "Base/Motion.h"
#include "Base/Parallel.h"
#include "Base/Pose.h"
#include "Base/Result.h"
#include "Base/SceneFrame.h"
#include "Base/Shape.h"
#include "Constraints/Constraint.h"
#include "Obstacles/ObstacleSet.h"
#include "Rotation/AirOnTracks.h"
#include "Rotation/PreparedShapes.h"
#include "Rotation/TurningOptions.h"

#include <limits>
#include <string>
#include <vector>

namespace waft
{

/// Members have the defaults; Visit says the rest of each field.
struct RotationOptions : TurningOptions
{
  double LandingTime = 0.7;
  double TurningTime = 2.0;
  double TurningRate = 60.0;
  bool KeepApart = true;
  std::uint64_t Seed = 1;

  Result Validate() const { return ValidateFields<RotationOptions>(*this); }

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    TurningOptions::Visit(visit, of...);
    visit(
      OptionField{
        "LandingTime", { 0, 1000 }, "s", "Seconds in which a body settles before it rests." },
      of.LandingTime...);
    visit(
      OptionField{
        "TurningTime",
        { 0, 1000 },
        "s",
        "Longest time, in seconds, over which an orientation row draws the pose towards it." },
      of.TurningTime...);
    visit(OptionField{ "TurningRate",
                       { 1, 1000 },
                       "rad/s",
                       "The fastest turn, in radians per second, that an orientation row may ask "
                       "for; one that asks for more is approached and named." },
          of.TurningRate...);
    visit(FlagField("KeepApart",
                    "Bodies whose meshes would be in each other in flight are turned a little, and "
                    "where that does not do shifted a little, so that they pass each other."),
          of.KeepApart...);
    visit(SeedField(), of.Seed...);
  }
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
  /// The air at all frames of Tracks, or none. With it neither Wind nor what tracks say of the air
  /// counts: bodies move relative to it, its gradient turns them, and half its vorticity is the
  /// turning that Damping draws them to.
  const AirOnTracks* Air = nullptr;
  /// Bodies are drawn by their weight alone, whatever their paths, and their Slips are given: where
  /// they glide is for who moves them. Tracks with Slips keep the poses that are theirs.
  bool Glides = false;
  /// Tracks with Slips keep their poses and slip anew by them, as SlipsAlong; with Glides.
  bool SlipsAlone = false;
  /// Frames after the first of which, up to the other, tracks with Slips turn anew all the same.
  int TurnsFrom = std::numeric_limits<int>::max();
  int TurnsUntil = std::numeric_limits<int>::max();
  PreparedShapes* Prepared = nullptr; // of an earlier run with these Shapes and options; or none
  /// Those besides rank 0 are in Serve meanwhile (Base/SharedWork.h); null: rank 0 alone.
  Communicator* Ranks = nullptr;
};

struct RotationOutput
{
  std::vector<PoseTrack> Poses;     // in the order of Tracks
  std::vector<BodyFactors> Factors; // of each object, in the order of Tracks
  double TurningLimit = 0.0;        // rad, the most that a body may turn from a frame to the next
  /// m, by which centres are moved so that meshes touch surfaces and do not cut them: in the order
  /// of Tracks, one a frame, or empty for a track that stays; as bodies land and lie by what their
  /// poses ask for, upwards, besides by at most 1e-3 of the volume's width; those that pass each
  /// other by up to a quarter of their length.
  std::vector<std::vector<Vec3>> Shifts;
  /// rad, how far half a second of turning in the air leads away from the poses that tracks came
  /// with (Rotation/Agreement.h); empty for those that came without. In the order of Tracks.
  std::vector<std::vector<double>> Away;
  /// Those given, rests with TouchDown, the frame of the first contact, and Settled.
  std::vector<Constraint> Constraints;
  /// One line for each orientation row: judged by itself, then measured on the poses, with the
  /// reason where the greatest turning rate does not do. Then one for each position that asks where
  /// its body faces, by how much it is missed [rad], and one for each rest that is kept.
  std::vector<ReportRow> Report;
  std::vector<std::string> Warnings; // objects and shapes are named; rows that are not met too
};

/// Fails when a shape has no area, a mass is not positive, a track has no object or another length;
/// nothing is written then but, for a monitor that publishes, Poses of the first tracks: those
/// turned so far. Results do not depend on the number of threads.
Result RunRotationRefine(const RotationInput& input, const RotationOptions& options,
                         const ParallelFor& parallel, Monitor& monitor, RotationOutput& output);

/// Moves the centres of tracks, in their order, by the Shifts; gives the farthest of each [m].
std::vector<double> ApplyShifts(const RotationOutput& rotation, std::vector<Track>& tracks);

} // namespace waft
