// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/BodyTurner.h"

#include "Base/BodyLaw.h"
#include "Base/FractionDone.h"
#include "Base/SharedLoop.h"
#include "Constraints/Rest.h"
#include "Rotation/Agreement.h"
#include "Rotation/Pace.h"
#include "Rotation/TurnLimit.h"
#include "Rotation/TurningSetup.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <type_traits>
#include <utility>

namespace waft
{
namespace
{

constexpr std::size_t Batch = 8;          // objects between two ticks of the monitor
constexpr std::size_t FewestToShare = 32; // fewer are turned sooner than others have begun
constexpr int AtOnce = 32; // bodies a thread of another rank, which then asks for more

PlannedRest LandingOf(const Constraint& row, const MotionObject& object, const RotationInput& input)
{
  std::vector<LandingWindow> windows;
  if (input.Obstacles != nullptr)
  {
    windows = LandingWindows(object, { row }, *input.Obstacles, input.Scene.Time.FramesPerSecond);
  }
  if (windows.empty())
  {
    LandingWindow level; // nothing below
    level.Frame = row.Frame;
    level.Until = LastFrame(row);
    windows.push_back(level);
  }
  PlannedRest rest{ windows.front() };
  const bool isAsked = row.Target != OfNoRow;
  // What came in a window lies still a second after it may touch.
  const double second = input.Scene.Time.FramesPerSecond;
  const int still =
    row.Frame + (row.FrameFrom >= 0 ? static_cast<int>(second - SinkingFrames(object, second)) : 0);
  rest.Deadline = isAsked ? std::max(still, rest.Frame) : rest.Until;
  rest.Side = row.Side;
  return rest;
}

AttitudePlan MakePlan(const RotationInput& input, const RotationOptions& options,
                      const RowsOfObjects& places, const MotionObject& object, const Track& track)
{
  AttitudePlan plan;
  plan.Object = &object;
  plan.Path = &track;
  plan.Body = &input.Shapes[object.ShapeId];
  plan.Obstacles = input.Obstacles;
  plan.Time = input.Scene.Time;
  plan.Seed = options.Seed;
  plan.LandingTime = options.LandingTime;
  plan.TurningTime = options.TurningTime;
  plan.TurningRate = options.TurningRate;
  plan.Tolerance = 1e-3 * input.Scene.Bounds.Width();
  const int last = static_cast<int>(track.Positions.size()) - 1;
  for (const std::size_t place : places.Of(object.ObjectId))
  {
    const Constraint& row = input.Constraints[place];
    // A row that an earlier stage found impossible does not bind; how near a position is come to
    // stays.
    const bool binds = row.Status == ConstraintStatus::Met ||
                       (row.Status == ConstraintStatus::Unreachable && IsPassing(row.Kind));
    if (!binds || row.Frame < 0 || row.Frame > last)
    {
      continue;
    }
    switch (row.Kind)
    {
      case ConstraintKind::Position:
        for (int k = row.Frame; k <= std::min(LastFrame(row), last); ++k)
        {
          plan.Held.push_back(k);
        }
        if (IsLasting(row))
        {
          plan.Stays.push_back(row);
        }
        if (!row.Facing.isZero())
        {
          plan.Keys.push_back(row);
        }
        break;
      case ConstraintKind::Velocity:
      case ConstraintKind::Acceleration:
        // These are about differences of neighbours, at the ends of the three or four nearest.
        for (int k = std::max(row.Frame - 3, 0); k <= std::min(row.Frame + 3, last); ++k)
        {
          plan.Held.push_back(k);
        }
        break;
      case ConstraintKind::Orientation:
        plan.Keys.push_back(row);
        break;
      case ConstraintKind::Rest:
        plan.Rests.push_back(LandingOf(row, object, input));
        break;
    }
  }
  const auto earlier = [](const auto& a, const auto& b) { return a.Frame < b.Frame; };
  // Of one frame a whole orientation counts.
  std::stable_sort(plan.Keys.begin(), plan.Keys.end(),
                   [](const Constraint& a, const Constraint& b) {
                     return a.Frame < b.Frame ||
                            (a.Frame == b.Frame && IsAttitude(a.Kind) && !IsAttitude(b.Kind));
                   });
  std::stable_sort(plan.Rests.begin(), plan.Rests.end(), earlier);
  for (std::size_t i = 0; i + 1 < plan.Rests.size(); ++i)
  {
    plan.Rests[i].Until = std::min(plan.Rests[i].Until, plan.Rests[i + 1].Frame);
  }
  return plan;
}

/// What bodies turn by beside the input, as other ranks are told it.
struct TurningJob
{
  std::vector<ObstacleMesh> Obstacles;
  std::vector<double> Draws;          // by shape; below 0: nobody has it
  std::vector<std::vector<Vec3>> Air; // by track and frame; or empty
  std::vector<std::vector<Mat3>> Gradients;
};

template <class Job, class Input, class Options>
void MoveJob(StateArchive& stream, Job& job, Input& input, Options& options)
{
  stream.Values(input.Scene, input.Objects, input.Tracks, input.Shapes, input.Constraints,
                input.Glides, input.SlipsAlone, input.TurnsFrom, input.TurnsUntil, job.Obstacles,
                job.Draws, job.Air, job.Gradients);
  RotationOptions::Visit(stream, options);
}

TurningJob JobOf(const RotationInput& input, const PreparedShapes& shapes)
{
  TurningJob job;
  if (input.Obstacles != nullptr)
  {
    job.Obstacles = input.Obstacles->Obstacles();
  }
  for (const PreparedShape& shape : shapes)
  {
    job.Draws.push_back(shape.IsPrepared ? shape.Draw : -1.0);
  }
  const bool hasAir = input.Air != nullptr && !input.Air->IsEmpty();
  for (std::size_t i = 0; hasAir && i < input.Tracks.size(); ++i)
  {
    job.Air.emplace_back();
    job.Gradients.emplace_back();
    for (std::size_t k = 0; k < input.Tracks[i].Positions.size(); ++k)
    {
      job.Air.back().push_back(input.Air->Velocity(i, k));
      job.Gradients.back().push_back(input.Air->Gradient(i, k));
    }
  }
  return job;
}

static_assert(std::is_trivially_copyable_v<BodyFactors>, "it is told as its bytes");

struct KeyTooFast
{
  int Row = 0, Target = 0;
  std::string Why;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Row...);
    visit(of.Target...);
    visit(of.Why...);
  }
};

void Write(const BodyTurn& turn, StateArchive& stream)
{
  const AttitudeOutcome& outcome = turn.Outcome;
  std::vector<KeyTooFast> tooFast;
  for (const auto& [key, why] : outcome.TooFast)
  {
    tooFast.push_back({ key.first, key.second, why });
  }
  std::vector<std::array<int, 4>> rests;
  for (const RestTimes& rest : outcome.Rests)
  {
    rests.push_back({ rest.Row, rest.Target, rest.TouchDown, rest.Settled });
  }
  stream.Values(outcome.Poses, outcome.Shifts, tooFast, rests, outcome.Warnings, outcome.Slowed,
                outcome.Swept, turn.Away);
  stream.Raw(&turn.Factors, sizeof(turn.Factors));
}

void Read(StateArchive& stream, BodyTurn& turn)
{
  AttitudeOutcome& outcome = turn.Outcome;
  std::vector<KeyTooFast> tooFast;
  std::vector<std::array<int, 4>> rests;
  stream.Values(outcome.Poses, outcome.Shifts, tooFast, rests, outcome.Warnings, outcome.Slowed,
                outcome.Swept, turn.Away);
  stream.Raw(&turn.Factors, sizeof(turn.Factors));
  for (const KeyTooFast& key : tooFast)
  {
    outcome.TooFast[{ key.Row, key.Target }] = key.Why;
  }
  for (const auto& [row, target, touchDown, settled] : rests)
  {
    outcome.Rests.push_back({ row, target, touchDown, settled });
  }
}

Result TurnByRanks(const BodyTurner& turner, Communicator& ranks, const ParallelFor& parallel,
                   Monitor& monitor, std::vector<BodyTurn>& turned)
{
  std::atomic<bool> stop{ false };
  std::atomic<std::size_t> done{ 0 };
  SharedLoop loop;
  loop.Kind = TurningKind;
  for (std::size_t i = 0; i < turned.size(); ++i)
  {
    loop.Items.push_back(i);
  }
  loop.Tell = [&](StateArchive& stream)
  {
    const TurningJob job = JobOf(turner.Input(), turner.Shapes());
    MoveJob(stream, job, turner.Input(), turner.Options());
  };
  loop.Work = [&](std::size_t i)
  {
    turned[i] = turner.Turn(i);
    ++done;
  };
  loop.Take = [&](std::size_t i, ReadingStream& stream)
  {
    Read(stream, turned[i]);
    ++done;
  };
  loop.Watch = [&]
  { stop = !monitor.Tick(0.1 + 0.9 * FractionDone(done, turned.size()), "Turning objects"); };
  loop.IsWatched = true;
  const Result shared = RunShared(loop, &ranks, parallel, stop);
  return !shared || !stop ? shared : Result::Stopped();
}

} // namespace

BodyTurner::BodyTurner(const RotationInput& input, const RotationOptions& options,
                       const PreparedShapes& shapes) :
  Given(input),
  Chosen(options), Prepared(shapes), Places(input.Constraints),
  Limit(MostTurn(options.MaximumTurn, input.Scene.Time))
{
  for (std::size_t i = 0; i < input.Objects.size(); ++i)
  {
    this->ObjectOfId[input.Objects[i].ObjectId] = i;
  }
}

// act(plan, glider, body, path, draw)
template <class Act>
void BodyTurner::Set(std::size_t i, const Act& act) const
{
  const RotationInput& input = this->Given;
  const Track& track = input.Tracks[i];
  const MotionObject& object = input.Objects[this->ObjectOfId.at(track.ObjectId)];
  const PreparedShape& shape = this->Prepared[static_cast<std::size_t>(object.ShapeId)];
  const Glider glider = GliderOf(input, this->Chosen, shape, object);
  double draw = input.Glides || HasFlown(track) ? shape.Draw * LawOf(object).SettlingSpeed() : 0.0;
  const FlightBody body = glider.DrawnAt(draw);
  draw = body.Slips ? draw : 0.0;
  AttitudePlan plan = MakePlan(input, this->Chosen, this->Places, object, track);
  plan.BoundingRadius = shape.Properties.BoundingRadius;
  plan.Glides = input.Glides;
  plan.TurnsFrom = input.TurnsFrom;
  plan.TurnsUntil = input.TurnsUntil;
  FlightPath path = MakePath(input, i, draw, glider.Pace);
  path.Ease = glider.Ease;
  if (draw > 0.0)
  {
    EndDraw(plan, path);
  }
  act(plan, glider, body, path, draw);
}

BodyTurn BodyTurner::Turn(std::size_t i) const
{
  BodyTurn turn;
  this->Set(i,
            [&](const AttitudePlan& plan, const Glider& glider, const FlightBody& body,
                FlightPath& path, double draw)
            {
              turn.Factors = glider.FactorsAt(draw);
              if (this->Given.SlipsAlone)
              {
                const Track& track = *plan.Path;
                SetLimit(this->Limit, path);
                PoseTrack& poses = turn.Outcome.Poses;
                poses.ObjectId = track.ObjectId;
                poses.Orientations = track.Orientations;
                poses.AngularVelocities = track.AngularVelocities;
                poses.Slips = draw > 0.0 ? SlipsAlong(plan, body, path) : track.Slips;
                turn.Outcome.Slowed.assign(poses.Slips.size(), 0);
                turn.Outcome.Swept.assign(poses.Slips.size(), 0.0);
                return;
              }
              turn.Outcome = TurnObjectWithin(this->Limit, plan, body, path);
              const bool turnsAnew = plan.TurnsFrom < static_cast<int>(plan.Path->Positions.size());
              if (HasFlown(this->Given.Tracks[i]) && !turnsAnew && draw > 0.0)
              {
                turn.Away = this->AwayFrom(i, plan, body, path, turn.Outcome.Poses);
              }
            });
  return turn;
}

std::vector<double> BodyTurner::AwayFrom(std::size_t i, const AttitudePlan& plan,
                                         const FlightBody& body, FlightPath& path,
                                         const PoseTrack& poses) const
{
  SetLimit(this->Limit, path);
  return TurnedAway(plan, body, path, poses, AgreementSampleOf(i, this->Given.Tracks.size()));
}

std::vector<double> BodyTurner::AwayOf(std::size_t i, const PoseTrack& poses) const
{
  std::vector<double> away;
  this->Set(i,
            [&](const AttitudePlan& plan, const Glider&, const FlightBody& body, FlightPath& path,
                double draw)
            {
              if (HasFlown(this->Given.Tracks[i]) && draw > 0.0)
              {
                away = this->AwayFrom(i, plan, body, path, poses);
              }
            });
  return away;
}

Result TurnBodies(const BodyTurner& turner, const ParallelFor& parallel, Monitor& monitor,
                  std::vector<PoseTrack>& published, std::vector<BodyTurn>& turned)
{
  const RotationInput& input = turner.Input();
  turned.resize(input.Tracks.size());
  // A wind that is no air on tracks is rare, and stays here.
  const bool canTell = input.Wind == nullptr || input.Wind->IsEmpty() ||
                       (input.Air != nullptr && !input.Air->IsEmpty());
  if (input.Ranks != nullptr && input.Ranks->Size() > 1 && canTell && !monitor.Publishes() &&
      turned.size() >= FewestToShare)
  {
    return TurnByRanks(turner, *input.Ranks, parallel, monitor, turned);
  }
  for (std::size_t first = 0; first < turned.size(); first += Batch)
  {
    const std::size_t count = std::min(Batch, turned.size() - first);
    parallel(count,
             [&](std::size_t begin, std::size_t end)
             {
               for (std::size_t i = first + begin; i < first + end; ++i)
               {
                 turned[i] = turner.Turn(i);
               }
             });
    for (std::size_t i = first; monitor.Publishes() && i < first + count; ++i)
    {
      published.push_back(turned[i].Outcome.Poses);
    }
    if (!monitor.Tick(0.1 + 0.9 * FractionDone(first + count, turned.size()), "Turning objects"))
    {
      return Result::Stopped();
    }
  }
  return Result::Ok();
}

Result ServeTurning(ReadingStream& inputs, SharedItems& items, int atOnce,
                    const ParallelFor& parallel)
{
  TurningJob job;
  RotationInput input;
  RotationOptions options;
  MoveJob(inputs, job, input, options);
  inputs = ReadingStream(std::vector<char>()); // as large as all tracks
  ObstacleSet obstacles;
  WAFT_RETURN_IF_FAILED(obstacles.Build(job.Obstacles));
  input.Obstacles = job.Obstacles.empty() ? nullptr : &obstacles;
  const AirOnTracks air(job.Air, job.Gradients);
  input.Air = air.IsEmpty() ? nullptr : &air;
  PreparedShapes shapes(input.Shapes.size());
  for (std::size_t s = 0; s < shapes.size(); ++s)
  {
    if (job.Draws[s] >= 0.0)
    {
      WAFT_RETURN_IF_FAILED(Prepare(input, options, s, nullptr, parallel, shapes[s]));
      shapes[s].Draw = job.Draws[s];
    }
  }
  const BodyTurner turner(input, options, shapes);
  std::atomic<bool> stop{ false };
  ServeLoop(
    items, AtOnce * atOnce, parallel,
    [&](std::size_t i, StateArchive& result) { Write(turner.Turn(i), result); }, stop);
  return Result::Ok();
}

} // namespace waft
