// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/BodyTurning.h"

#include "Air/Drift/DriftSearch.h"
#include "Air/Run/AirLoop.h"
#include "Air/Run/BodyDrift.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace waft
{
namespace
{

constexpr double Degree = 0.017453292519943295;  // rad
constexpr double AgreeingMedian = 15.0 * Degree; // rad, that is wanted of each body
constexpr double AgreeingHigh = 45.0 * Degree;   // of the 90th percentile
constexpr double StepTime = 1.0 / 3.0;           // s
constexpr int StepsAhead = 3;                    // that are turned, for the path to know of them
constexpr int StepIterations = 4;                // of the path, after each
constexpr const char* DriftingText = "Letting the objects drift to their marks";
constexpr const char* TurningText = "Turning the objects in the air";
constexpr std::size_t TurnedAtOnce = 1024; // bodies
constexpr std::size_t MostTurnedAnew = 2048;
constexpr std::size_t FewestForPercentiles = 8; // bodies

struct Turning
{
  RotationInput Input;
  std::vector<std::size_t> Which; // bodies, by track
  AirOnTracks Air;
};

/// From `next` on, those that may turn anew, so many at most; next: the one after them.
void Choose(const AirBodies& bodies, const std::vector<char>& which, std::size_t most,
            std::size_t& next, Turning& turning)
{
  for (; next < bodies.Size() && turning.Which.size() < most; ++next)
  {
    if (which[next] && !bodies.IsKept(next))
    {
      turning.Which.push_back(next);
    }
  }
}

/// Those that were chosen, with their touch-downs as they are, in the air about their paths.
/// flown: with the poses that they have.
void SetUp(const AirContext& run, const HalfSeries& series, bool flown, AirBodies& bodies,
           Turning& turning)
{
  RotationInput& input = turning.Input;
  input.Scene = run.Input.Scene;
  input.Shapes = run.Input.Shapes;
  input.Obstacles = &run.Obstacles;
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
  const AirSampler air(series);
  std::vector<std::vector<Vec3>> velocities(input.Tracks.size());
  std::vector<std::vector<Mat3>> gradients(input.Tracks.size());
  run.Parallel(input.Tracks.size(),
               [&](std::size_t begin, std::size_t end)
               {
                 for (std::size_t i = begin; i < end; ++i)
                 {
                   const std::vector<Vec3>& path = input.Tracks[i].Positions;
                   velocities[i].resize(path.size());
                   gradients[i].resize(path.size());
                   for (std::size_t k = 0; k < path.size(); ++k)
                   {
                     velocities[i][k] = air.At(static_cast<int>(k), path[k], &gradients[i][k]);
                   }
                 }
               });
  turning.Air = AirOnTracks(velocities, gradients);
  input.Air = &turning.Air;
}

RotationOptions OptionsOf(const AirContext& run)
{
  RotationOptions options = run.Input.Turning;
  options.Seed = SeedOfAir(run.Input, run.Options);
  options.KeepApart = false; // they drift on from here
  return options;
}

enum class How
{
  Anew,
  AsFlown,   // with the poses that they have
  SlipsAlone // likewise, and how they slip by these
};

/// Turns those that may turn anew, so many at a time: what is needed meanwhile of each is three
/// times what is kept of it. take(o, i, turned): of the body o, the i-th of those turned.
template <class Take>
Result Turn(const AirContext& run, const HalfSeries& air, const std::vector<char>& which, How how,
            AirBodies& bodies, const Take& take)
{
  PartMonitor monitor(run.Caller, -1.0, -1.0, TurningText);
  for (std::size_t next = 0; next < bodies.Size();)
  {
    Turning turning;
    Choose(bodies, which, TurnedAtOnce, next, turning);
    if (turning.Which.empty())
    {
      break;
    }
    SetUp(run, air, how != How::Anew, bodies, turning);
    turning.Input.SlipsAlone = how == How::SlipsAlone;
    turning.Input.Glides = how != How::AsFlown;
    RotationOutput turned;
    const Result result =
      RunRotationRefine(turning.Input, OptionsOf(run), run.Parallel, monitor, turned);
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

// How far half a second of turning leads away from the poses of those that glide [rad], as they are
// in the air as it is; nothing of whom there is nothing to be said.
Result FindAway(const AirContext& run, const HalfSeries& air, const std::vector<char>& which,
                AirBodies& bodies, std::vector<std::vector<double>>& away)
{
  away.assign(bodies.Size(), {});
  if (bodies.Poses.empty() || bodies.Size() > MostTurnedAnew)
  {
    return Result::Ok();
  }
  const auto take = [&away](std::size_t o, std::size_t i, RotationOutput& turned)
  {
    if (i < turned.Away.size())
    {
      away[o] = std::move(turned.Away[i]);
    }
  };
  return Turn(run, air, which, How::AsFlown, bodies, take);
}

// How far a body is from what is wanted of its agreement, in the median or in the 90th percentile:
// at most 1 where it agrees.
// few: the scene has so few bodies that each one's windows decide on its percentiles. Then the
// ranks above count, else the nearest.
double Disagreement(std::vector<double> away, bool few)
{
  if (away.empty())
  {
    return 0.0;
  }
  std::sort(away.begin(), away.end());
  const auto at = [&](double share)
  {
    const double rank = share * static_cast<double>(away.size() - 1);
    return away[static_cast<std::size_t>(few ? std::ceil(rank - 1e-9) : rank + 0.5)];
  };
  return std::max(at(0.5) / AgreeingMedian, at(0.9) / AgreeingHigh);
}

bool AreFew(const AirBodies& bodies)
{
  return bodies.Size() < FewestForPercentiles;
}

// Its poses after a frame, and the slips of these up to another; what else was before stays.
void TakePoses(int frame, int until, const AirContext& run, std::size_t o, PoseTrack& turned,
               AirBodies& bodies)
{
  const double glide = run.Options.Glide;
  const std::vector<Vec3> before = std::move(bodies.Poses[o].Slips);
  PoseTrack& poses = bodies.Poses[o];
  poses = std::move(turned);
  poses.Torques = {}; // which nobody asks for here
  const Vec3 sinking = LawOf(bodies.Problems[o].Object()).Velocity(Vec3::Zero());
  for (std::size_t k = 0; k < poses.Slips.size(); ++k)
  {
    Vec3& slip = poses.Slips[k];
    const bool stays = static_cast<int>(k) <= frame || static_cast<int>(k) > until;
    slip = stays ? before[k] : glide * slip + (1.0 - glide) * sinking;
  }
  bodies.Problems[o].SetSlips(poses.Slips);
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
  track.TakeTimes(bodies.Problems[o].Object());
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
  const auto take = [&poses](std::size_t o, std::size_t i, RotationOutput& turned)
  { poses[o] = std::move(turned.Poses[i]); };
  const Result result = Turn(run, air, which, How::Anew, bodies, take);
  if (!result || result.IsStopped())
  {
    return result;
  }
  bodies.Poses.resize(bodies.Size());
  for (std::size_t o = 0; o < bodies.Size(); ++o)
  {
    if (which[o] && !bodies.IsKept(o))
    {
      TakePoses(-1, std::numeric_limits<int>::max(), run, o, poses[o], bodies);
    }
  }
  TurnIntoStarts(run, bodies);
  PartMonitor drifting(run.Caller, -1.0, -1.0, DriftingText);
  return DriftOn(run, air, iterations, bodies, drifting);
}

namespace
{

Result TurnStepwise(const AirContext& run, const HalfSeries& air, const std::vector<char>& which,
                    AirBodies& bodies)
{
  const AirSampler sampler(air);
  const int frames = run.Input.Scene.Time.NumberOfFrames;
  const int stride =
    std::max(1, static_cast<int>(std::lround(StepTime * run.Input.Scene.Time.FramesPerSecond)));
  const int ahead = StepsAhead * stride;
  for (int first = 0; first < frames - 1; first += stride)
  {
    Turning turning;
    std::size_t next = 0;
    Choose(bodies, which, bodies.Size(), next, turning);
    SetUp(run, air, true, bodies, turning);
    turning.Input.Glides = true;
    turning.Input.TurnsFrom = first;
    turning.Input.TurnsUntil = first + ahead;
    RotationOutput turned;
    PartMonitor monitor(run.Caller, -1.0, -1.0, TurningText);
    const Result result =
      RunRotationRefine(turning.Input, OptionsOf(run), run.Parallel, monitor, turned);
    if (!result || result.IsStopped())
    {
      return result;
    }
    for (std::size_t i = 0; i < turning.Which.size(); ++i)
    {
      TakePoses(first, first + ahead, run, turning.Which[i], turned.Poses[i], bodies);
    }
    run.Parallel(turning.Which.size(),
                 [&](std::size_t begin, std::size_t end)
                 {
                   for (std::size_t i = begin; i < end; ++i)
                   {
                     const std::size_t o = turning.Which[i];
                     DriftProblem problem = bodies.Problems[o].In(sampler);
                     for (std::size_t k = 0; k <= static_cast<std::size_t>(first); ++k)
                     {
                       problem.IsFixed[k] = 1;
                       problem.Fixed[k] = bodies.Paths[o][k];
                     }
                     SolveDrift(problem, sampler, run.Search.Weights, StepIterations,
                                bodies.Paths[o]);
                   }
                 });
  }
  TurnIntoStarts(run, bodies);
  return Result::Ok();
}

} // namespace

Result SlipAnew(const AirContext& run, const HalfSeries& air, AirBodies& bodies)
{
  if (bodies.Poses.empty())
  {
    return Result::Ok();
  }
  const double glide = run.Options.Glide;
  const auto take = [&](std::size_t o, std::size_t i, RotationOutput& turned)
  {
    std::vector<Vec3>& slips = bodies.Poses[o].Slips;
    const std::vector<Vec3>& lawful = turned.Poses[i].Slips;
    for (std::size_t k = 0; k < std::min(slips.size(), lawful.size()); ++k)
    {
      slips[k] += glide * (lawful[k] - slips[k]);
    }
    bodies.Problems[o].SetSlips(slips);
  };
  const Result result = Turn(run, air, Everybody(bodies), How::SlipsAlone, bodies, take);
  TurnIntoStarts(run, bodies);
  return result;
}

Result TurnDisagreeing(const AirContext& run, const HalfSeries& air, AirBodies& bodies)
{
  std::vector<std::vector<double>> away;
  const Result found = FindAway(run, air, Everybody(bodies), bodies, away);
  if (!found || found.IsStopped())
  {
    return found;
  }
  std::vector<char> which;
  for (const std::vector<double>& own : away)
  {
    which.push_back(Disagreement(own, AreFew(bodies)) > 1.0 ? 1 : 0);
  }
  return IsNobody(which) ? found : TurnStepwise(run, air, which, bodies);
}

} // namespace waft
