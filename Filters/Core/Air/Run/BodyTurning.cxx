// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/BodyTurning.h"

#include "Air/Drift/DriftSearch.h"
#include "Air/Run/AirRounds.h"
#include "Air/Run/BodyDrift.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace waft
{
namespace
{

constexpr const char* TurningText = "Turning the objects in the air";
constexpr std::size_t TurnedAtOnce = 1024; // bodies

struct Turning
{
  RotationInput Input;
  std::vector<std::size_t> Which; // bodies, by track
  AirOnTracks Air;
};

/// Bodies, with their touch-downs as they are, in the air about their paths. flown: with the poses
/// that they have.
Result SetUp(const AirContext& run, const HalfSeries& series, bool flown, AirBodies& bodies,
             Turning& turning)
{
  RotationInput& input = turning.Input;
  input.Scene = run.Input.Scene;
  input.Shapes = run.Input.Shapes;
  input.Obstacles = &run.Obstacles;
  input.Glides = !flown;
  input.Prepared = &bodies.Shapes;
  input.Ranks = run.Input.Ranks;
  for (const std::size_t o : turning.Which)
  {
    const BodyProblem& body = bodies.Problems[o];
    input.Objects.push_back(body.Object());
    input.Tracks.push_back(flown ? FlownTrack(bodies, o) : Track());
    input.Tracks.back().ObjectId = body.Object().ObjectId;
    input.Tracks.back().Positions = bodies.Paths[o];
    input.Constraints.insert(input.Constraints.end(), body.Rows().begin(), body.Rows().end());
  }
  const Timeline& line = run.Input.Scene.Time;
  turning.Air = AirOnTracks(input.Tracks, line);
  for (int frame = 0; frame < line.NumberOfFrames; ++frame)
  {
    WAFT_RETURN_IF_FAILED(turning.Air.Add(FieldAt(series, line.Time(frame))));
  }
  turning.Air.Finish();
  input.Air = &turning.Air;
  return Result::Ok();
}

RotationOptions OptionsOf(const AirContext& run)
{
  RotationOptions options = run.Input.Turning;
  options.Seed = SeedOfAir(run.Input, run.Options);
  options.KeepApart = false; // they drift on from here
  return options;
}

/// Turns those that may turn anew, so many at a time: what is needed meanwhile of
/// each is three times what is kept of it. take(o, i, turned): of the body o, the i-th of those
/// turned.
template <class Take>
Result Turn(const AirContext& run, const HalfSeries& air, const std::vector<char>& which,
            bool flown, AirBodies& bodies, const Take& take)
{
  std::size_t next = 0;
  const RotationOptions options = OptionsOf(run);
  PartMonitor monitor(run.Caller, -1.0, -1.0, TurningText);
  while (next < bodies.Size())
  {
    Turning turning;
    for (; next < bodies.Size() && turning.Which.size() < TurnedAtOnce; ++next)
    {
      if (which[next] && !bodies.IsKept(next))
      {
        turning.Which.push_back(next);
      }
    }
    if (turning.Which.empty())
    {
      break;
    }
    WAFT_RETURN_IF_FAILED(SetUp(run, air, flown, bodies, turning));
    RotationOutput turned;
    const Result result = RunRotationRefine(turning.Input, options, run.Parallel, monitor, turned);
    if (!result || result.IsStopped())
    {
      return result;
    }
    for (std::size_t i = 0; i < turning.Which.size(); ++i)
    {
      take(turning.Which[i], i, turned);
    }
  }
  return Result::Ok();
}

// Whose mean agreement is beyond these degrees.
Result FindDisagreeing(const AirContext& run, const HalfSeries& air, double degrees,
                       AirBodies& bodies, std::vector<char>& which)
{
  which.assign(bodies.Size(), 0);
  if (bodies.Poses.empty())
  {
    return Result::Ok();
  }
  const double most = degrees * std::acos(-1.0) / 180.0;
  std::vector<char> found(bodies.Size(), 0);
  const auto judge = [&](std::size_t o, std::size_t i, const RotationOutput& turned)
  {
    const std::vector<double>& away = turned.Away[i];
    const double sum = std::accumulate(away.begin(), away.end(), 0.0);
    found[o] = sum > most * static_cast<double>(away.size()) ? 1 : 0;
  };
  const Result result = Turn(run, air, Everybody(bodies), true, bodies, judge);
  if (result && !result.IsStopped())
  {
    which = std::move(found);
  }
  return result;
}

bool IsNobody(const std::vector<char>& which)
{
  return std::find(which.begin(), which.end(), 1) == which.end();
}

} // namespace

FieldSeries FieldAt(const HalfSeries& air, double time)
{
  FieldSeries now{ static_cast<const SeriesLattice&>(air) };
  now.Times = { time };
  now.Values = { air.Around(time).At(time) };
  return now;
}

Track FlownTrack(const AirBodies& bodies, std::size_t o)
{
  Track track;
  track.ObjectId = bodies.Problems[o].Object().ObjectId;
  track.Positions = bodies.Paths[o];
  if (!bodies.Poses.empty())
  {
    track.Slips = bodies.Poses[o].Slips;
    track.Orientations = bodies.Poses[o].Orientations;
    track.AngularVelocities = bodies.Poses[o].AngularVelocities;
  }
  return track;
}

Result TurnAndDrift(const AirContext& run, const HalfSeries& air, int iterations,
                    const std::vector<char>& which, AirBodies& bodies)
{
  if (!GlidesIn(run.Input, run.Options))
  {
    return Result::Ok();
  }
  std::vector<PoseTrack> poses(bodies.Size());
  const auto take = [&](std::size_t o, std::size_t i, RotationOutput& turned)
  {
    poses[o] = std::move(turned.Poses[i]);
    poses[o].Torques = {}; // which nobody asks for here
  };
  const Result result = Turn(run, air, which, false, bodies, take);
  if (!result || result.IsStopped())
  {
    return result;
  }
  bodies.Poses.resize(bodies.Size());
  const double glide = run.Options.Glide;
  for (std::size_t o = 0; o < bodies.Size(); ++o)
  {
    if (!which[o] || bodies.IsKept(o))
    {
      continue;
    }
    const Vec3 sinking = LawOf(bodies.Problems[o].Object()).Velocity(Vec3::Zero());
    for (Vec3& slip : poses[o].Slips)
    {
      slip = glide * slip + (1.0 - glide) * sinking;
    }
    bodies.Problems[o].SetSlips(poses[o].Slips);
    bodies.Poses[o] = std::move(poses[o]);
  }
  PartMonitor drifting(run.Caller, -1.0, -1.0, "Letting the objects drift to their marks");
  return DriftOn(run, air, iterations, bodies, drifting);
}

Result TurnDisagreeing(const AirContext& run, const HalfSeries& air, double degrees,
                       AirBodies& bodies)
{
  std::vector<char> which;
  const Result found = FindDisagreeing(run, air, degrees, bodies, which);
  return IsNobody(which) ? found : TurnAndDrift(run, air, FurtherIterations, which, bodies);
}

Result TurnAstray(const AirContext& run, const HalfSeries& air, double degrees, AirBodies& bodies)
{
  std::vector<char> which;
  const Result found = FindDisagreeing(run, air, degrees, bodies, which);
  if (IsNobody(which))
  {
    return found;
  }
  const auto shares = [&]
  {
    std::vector<double> each;
    for (const ResidualControl& own : ResidualControlsOf(run, bodies, air))
    {
      each.push_back(own.Rms(own.Control) / std::max(own.Rms(own.Flow), 1e-12));
    }
    return each;
  };
  std::vector<std::vector<Vec3>> paths(bodies.Size());
  std::vector<PoseTrack> poses(bodies.Size());
  for (std::size_t o = 0; o < bodies.Size(); ++o)
  {
    if (which[o])
    {
      paths[o] = bodies.Paths[o];
      poses[o] = bodies.Poses[o];
    }
  }
  const std::vector<double> before = shares();
  const Result turned = TurnAndDrift(run, air, DriftIterations, which, bodies);
  const std::vector<double> after = shares();
  for (std::size_t o = 0; o < bodies.Size(); ++o)
  {
    if (which[o] && !bodies.IsKept(o) && after[o] > std::max(EnoughControl, before[o]))
    {
      bodies.Paths[o] = paths[o];
      bodies.Poses[o] = poses[o];
      bodies.Problems[o].SetSlips(poses[o].Slips);
    }
  }
  return turned;
}

} // namespace waft
