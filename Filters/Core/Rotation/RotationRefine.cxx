// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/RotationRefine.h"

#include "Base/FractionDone.h"
#include "Base/ShapeMeasures.h"
#include "Rotation/BodyTurner.h"
#include "Rotation/PartMeshes.h"
#include "Rotation/PoseRates.h"
#include "Rotation/RotationReport.h"
#include "Rotation/TurnLimit.h"
#include "Rotation/TurningSetup.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace waft
{
namespace
{
constexpr double SeldomSlowed = 0.05; // of a body's frames, by a limit that nobody set

bool IsBetween(double x, double low, double high)
{
  return std::isfinite(x) && x >= low && x <= high;
}

Result CheckTracks(const RotationInput& input, std::map<int, std::size_t>& objectOfId)
{
  for (std::size_t i = 0; i < input.Objects.size(); ++i)
  {
    const MotionObject& object = input.Objects[i];
    const std::string name = "object " + std::to_string(object.ObjectId);
    if (!objectOfId.emplace(object.ObjectId, i).second)
    {
      return Result::Error(name + " is there twice");
    }
    if (object.ShapeId < 0 || object.ShapeId >= static_cast<int>(input.Shapes.size()))
    {
      return Result::Error(name + ": ShapeId " + std::to_string(object.ShapeId) + " of " +
                           std::to_string(input.Shapes.size()) +
                           " shapes: expected a number below");
    }
    if (!(object.Mass > 0.0) || !std::isfinite(object.Mass))
    {
      return Result::Error(name + ": Mass must be positive");
    }
    if (!object.AngularVelocity.allFinite())
    {
      return Result::Error(name + ": AngularVelocity is not finite");
    }
  }
  for (const Track& track : input.Tracks)
  {
    const std::string name = "track of object " + std::to_string(track.ObjectId);
    if (objectOfId.count(track.ObjectId) == 0)
    {
      return Result::Error(name + ": there is no such object");
    }
    if (track.Positions.empty() || track.Positions.size() != input.Tracks[0].Positions.size())
    {
      return Result::Error(name + ": expected " + std::to_string(input.Tracks[0].Positions.size()) +
                           " frames, found " + std::to_string(track.Positions.size()));
    }
    const std::size_t frames = track.Positions.size();
    if (!track.AirVelocities.empty() && track.AirVelocities.size() != frames)
    {
      return Result::Error(name + ": AirVelocity has another length than the positions");
    }
    if (HasFlown(track) &&
        (track.Orientations.size() != frames || track.AngularVelocities.size() != frames ||
         track.Slips.size() != frames))
    {
      return Result::Error(name + ": expected Slip, Orientation and AngularVelocity of one length "
                                  "with the positions");
    }
    for (std::size_t k = 0; k < track.Positions.size(); ++k)
    {
      if (!track.Positions[k].allFinite() ||
          (!track.AirVelocities.empty() && !track.AirVelocities[k].allFinite()))
      {
        return Result::Error(name + ", frame " + std::to_string(k) + ": a number is not finite");
      }
    }
  }
  return Result::Ok();
}

/// What has been turned and shifted so that bodies pass each other, and what could not be helped.
bool KeepApart(const RotationInput& input, double most, const ParallelFor& parallel,
               Monitor& monitor, RotationOutput& result, PartedMotion& parted)
{
  std::vector<Track> tracks(input.Tracks.size()); // places alone
  for (std::size_t i = 0; i < tracks.size(); ++i)
  {
    tracks[i].ObjectId = input.Tracks[i].ObjectId;
    tracks[i].FirstPresent = input.Tracks[i].FirstPresent;
    tracks[i].Leave = input.Tracks[i].Leave;
    tracks[i].Positions = input.Tracks[i].Positions;
  }
  (void)ApplyShifts(result, tracks);
  if (!PartMeshes(input, result.Constraints, most, parallel, monitor, tracks, result.Poses, parted))
  {
    return false;
  }
  for (std::size_t i = 0; i < tracks.size(); ++i)
  {
    if (!parted.Turned[i].empty())
    {
      SetRatesWhereTurned(parted.Turned[i], input.Scene.Time.Step(), result.Poses[i]);
    }
    if (!parted.Shifts[i].empty())
    {
      result.Shifts[i].resize(parted.Shifts[i].size(), Vec3::Zero());
      std::transform(result.Shifts[i].begin(), result.Shifts[i].end(), parted.Shifts[i].begin(),
                     result.Shifts[i].begin(), std::plus<Vec3>());
    }
  }
  const std::vector<std::string> left = WarningsOfCuts(parted.Left, tracks);
  result.Warnings.insert(result.Warnings.end(), left.begin(), left.end());
  return true;
}

} // namespace

Result RunRotationRefine(const RotationInput& input, const RotationOptions& options,
                         const ParallelFor& parallel, Monitor& monitor, RotationOutput& output)
{
  WAFT_RETURN_IF_FAILED(options.Validate());
  std::map<int, std::size_t> objectOfId;
  WAFT_RETURN_IF_FAILED(CheckTracks(input, objectOfId));
  if (!IsBetween(input.Scene.AirDensity, 0.0, 1e6))
  {
    return Result::Error("AirDensity must be 0 or more");
  }

  std::vector<const MotionObject*> users(input.Shapes.size(), nullptr); // the first of each shape
  bool glides = input.Glides;
  for (const Track& track : input.Tracks)
  {
    const MotionObject& object = input.Objects[objectOfId[track.ObjectId]];
    const MotionObject*& user = users[static_cast<std::size_t>(object.ShapeId)];
    user = user != nullptr ? user : &object;
    glides = glides || HasFlown(track);
  }
  RotationOutput result;
  PreparedShapes own;
  PreparedShapes& shapes = input.Prepared != nullptr ? *input.Prepared : own;
  shapes.resize(input.Shapes.size());
  for (std::size_t s = 0; s < shapes.size(); ++s)
  {
    if (users[s] == nullptr)
    {
      continue;
    }
    const std::string flat = RemarkOnFlatTriangles(input.Shapes[s].Mesh);
    if (!flat.empty())
    {
      result.Warnings.push_back("shape '" + input.Shapes[s].Name + "': " + flat);
    }
    WAFT_RETURN_IF_FAILED(
      Prepare(input, options, s, glides ? users[s] : nullptr, parallel, shapes[s]));
    if (!monitor.Tick(0.1 * FractionDone(s + 1, shapes.size()),
                      "Looking at shapes from all around"))
    {
      return Result::Stopped();
    }
  }

  const BodyTurner turner(input, options, shapes);
  std::vector<BodyTurn> turned;
  const Result done = TurnBodies(turner, parallel, monitor, output.Poses, turned);
  if (!done || done.IsStopped())
  {
    return done;
  }

  std::map<std::pair<int, int>, std::string> tooFast;
  TurnCount turns(turner.Most(), options.MaximumTurn > 0.0 ? 0.0 : SeldomSlowed);
  result.Constraints = input.Constraints;
  result.TurningLimit = turner.Most();
  for (BodyTurn& turn : turned)
  {
    AttitudeOutcome& outcome = turn.Outcome;
    for (std::size_t k = 0; k < outcome.Poses.Orientations.size(); ++k)
    {
      if (!outcome.Poses.Orientations[k].coeffs().allFinite() ||
          !outcome.Poses.AngularVelocities[k].allFinite())
      {
        return Result::Error("object " + std::to_string(outcome.Poses.ObjectId) + ", frame " +
                             std::to_string(k) + ": its pose is not finite");
      }
    }
    turns.Add(outcome);
    for (const std::size_t place : turner.RowsOf(outcome.Poses.ObjectId))
    {
      TakeRestTimes(outcome.Rests, result.Constraints[place]);
    }
    result.Away.push_back(std::move(turn.Away));
    result.Factors.push_back(turn.Factors);
    result.Poses.push_back(std::move(outcome.Poses));
    result.Shifts.push_back(std::move(outcome.Shifts));
    tooFast.merge(outcome.TooFast);
    result.Warnings.insert(result.Warnings.end(), outcome.Warnings.begin(), outcome.Warnings.end());
  }
  if (options.KeepApart && !input.Glides)
  {
    PartedMotion parted;
    if (!KeepApart(input, turner.Most(), parallel, monitor, result, parted))
    {
      return Result::Stopped();
    }
    parallel(parted.Turned.size(),
             [&](std::size_t begin, std::size_t end)
             {
               for (std::size_t i = begin; i < end; ++i)
               {
                 if (!parted.Turned[i].empty())
                 {
                   result.Away[i] = turner.AwayOf(i, result.Poses[i]);
                 }
               }
             });
  }
  const std::vector<std::string> fast = turns.Warnings();
  result.Warnings.insert(result.Warnings.end(), fast.begin(), fast.end());
  ReportOrientations(input, tooFast, result);
  ReportFacings(input, tooFast, result);
  ReportRests(result);
  output = std::move(result);
  return Result::Ok();
}

std::vector<double> ApplyShifts(const RotationOutput& rotation, std::vector<Track>& tracks)
{
  std::vector<double> farthest(tracks.size(), 0.0);
  for (std::size_t i = 0; i < tracks.size(); ++i)
  {
    const std::vector<Vec3>& shifts = rotation.Shifts[i];
    for (std::size_t k = 0; k < shifts.size(); ++k)
    {
      tracks[i].Positions[k] += shifts[k];
      farthest[i] = std::max(farthest[i], shifts[k].norm());
    }
  }
  return farthest;
}

} // namespace waft
