// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/EachBody.h"

#include "Air/Drift/FreeLanding.h"
#include "Air/Run/AirSetup.h"
#include "Base/FractionDone.h"
#include "Base/SharedLoop.h"

#include <atomic>
#include <utility>

namespace waft
{
namespace
{

constexpr int LandingIterations = 24; // of a path that is good but for its end
// Fewer bodies drift on sooner than the air is sent; their searches take longer.
constexpr std::size_t FewestToShare = 128;
constexpr int AtOnce = 8; // bodies a thread of another rank, which asks for more when they are done

/// What a body has of its own beside what SetUpBodies gives it, before and after a task.
struct BodyState
{
  std::vector<Vec3> Path;
  std::vector<int> TouchDowns, LiftOffs; // one a landing
  std::vector<Vec3> Slips;               // of its poses; or empty
  FreeLanding Landed;                    // by the task

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Path...);
    visit(of.TouchDowns...);
    visit(of.LiftOffs...);
    visit(of.Slips...);
    visit(of.Landed.Frame...);
    visit(of.Landed.Place...);
  }
};

BodyState StateOf(const BodyProblem& body, const std::vector<Vec3>& path)
{
  BodyState state;
  state.Path = path;
  for (std::size_t l = 0; l < body.NumberOfLandings(); ++l)
  {
    state.TouchDowns.push_back(body.TouchDown(l));
    state.LiftOffs.push_back(body.LiftOff(l));
  }
  return state;
}

void SetTimes(const BodyState& state, BodyProblem& body)
{
  for (std::size_t l = 0; l < state.TouchDowns.size(); ++l)
  {
    body.SetTouchDown(l, state.TouchDowns[l]);
    body.SetLiftOff(l, state.LiftOffs[l]);
  }
}

/// The landing that it found, if that was its task.
FreeLanding Act(const AirContext& run, const AirSampler& air, BodyTask task, int iterations,
                BodyProblem& body, std::vector<Vec3>& path, Monitor& monitor)
{
  FreeLanding landing;
  switch (task)
  {
    case BodyTask::Seek:
      SeekPath(run.Search, air, body, path, monitor);
      break;
    case BodyTask::Drift:
      SolveDrift(body.In(air), air, run.Search.Weights, iterations, path);
      break;
    case BodyTask::Land:
      landing = FindFreeLanding(run.Around, body.Object(), air, path, body.FreeFrom());
      if (landing.Frame >= 0)
      {
        body.LandFreely(landing.Frame, landing.Place);
        SolveDrift(body.In(air), air, run.Search.Weights, LandingIterations, path);
      }
      break;
  }
  return landing;
}

/// All that bodies do depends on.
struct BodiesJob
{
  MotionProblem Problem; // of the Tracks their places alone
  AssimilationOptions Options;
  BodyTask Task = BodyTask::Seek;
  int Iterations = 0;
  bool HasSolids = false;
  std::vector<BodyState> Bodies; // empty of those that do nothing
};

/// Of the values of the series its holder.
template <class Job, class Series>
void MoveJob(StateArchive& stream, Job& job, Series& series)
{
  stream.Values(job.Problem, job.Task, job.Iterations, job.HasSolids, job.Bodies);
  AssimilationOptions::VisitAir(stream, job.Options);
  HalfSeries::VisitLattice(stream, series);
  stream.Values(series.Values);
}

BodiesJob JobOf(const AirContext& run, const std::vector<std::size_t>& which,
                const AirBodies& bodies)
{
  BodiesJob job;
  job.Problem.Scene = run.Input.Scene;
  job.Problem.Objects = run.Input.Objects;
  job.Problem.Constraints = run.Input.Constraints;
  job.Problem.Obstacles = run.Input.Obstacles;
  for (const Track& track : run.Input.Tracks)
  {
    job.Problem.Tracks.emplace_back();
    job.Problem.Tracks.back().ObjectId = track.ObjectId;
    job.Problem.Tracks.back().Positions = track.Positions;
  }
  job.Options = run.Options;
  job.HasSolids = run.Search.HasSolids;
  job.Bodies.resize(bodies.Size());
  for (const std::size_t o : which)
  {
    job.Bodies[o] = StateOf(bodies.Problems[o], bodies.Paths[o]);
    if (!bodies.Poses.empty())
    {
      job.Bodies[o].Slips = bodies.Poses[o].Slips;
    }
  }
  return job;
}

/// Goes on until somebody else says otherwise.
class StopMonitor : public Monitor
{
public:
  explicit StopMonitor(const std::atomic<bool>& stop) : Stop(stop) {}
  bool Tick(double, const std::string&) override { return !this->Stop; }

private:
  const std::atomic<bool>& Stop;
};

} // namespace

Result EachBody(const AirContext& run, const HalfSeries& series, BodyTask task, int iterations,
                const std::vector<char>& which, AirBodies& bodies, PartMonitor& monitor)
{
  const AirSampler air(series);
  std::atomic<bool> stop{ false };
  std::atomic<std::size_t> done{ 0 };
  SharedLoop loop;
  loop.Kind = BodiesKind;
  for (std::size_t o = 0; o < bodies.Size(); ++o)
  {
    if (which[o] && !bodies.IsKept(o))
    {
      loop.Items.push_back(o);
    }
  }
  loop.Tell = [&](StateArchive& stream)
  {
    BodiesJob job = JobOf(run, loop.Items, bodies);
    job.Task = task;
    job.Iterations = iterations;
    const BodiesJob& told = job;
    MoveJob(stream, told, series);
  };
  const auto goesOn = [&](std::size_t count)
  {
    stop = !monitor.Tick(FractionDone(count, loop.Items.size()), "") || stop;
    return !stop;
  };
  loop.Work = [&](std::size_t o)
  {
    if (goesOn(done++))
    {
      Act(run, air, task, iterations, bodies.Problems[o], bodies.Paths[o], monitor);
    }
  };
  loop.Take = [&](std::size_t o, ReadingStream& result)
  {
    BodyState state;
    result.Values(state);
    SetTimes(state, bodies.Problems[o]);
    if (state.Landed.Frame >= 0)
    {
      bodies.Problems[o].LandFreely(state.Landed.Frame, state.Landed.Place);
    }
    bodies.Paths[o] = std::move(state.Path);
    ++done;
  };
  loop.Watch = [&] { goesOn(done); };
  const bool isWorth = task == BodyTask::Seek || loop.Items.size() >= FewestToShare;
  const Result shared = RunShared(loop, isWorth ? run.Input.Ranks : nullptr, run.Parallel, stop);
  return !shared || !stop ? shared : Result::Stopped();
}

Result ServeBodies(ReadingStream& inputs, SharedItems& items, int atOnce,
                   const ParallelFor& parallel)
{
  BodiesJob job;
  HalfSeries series;
  MoveJob(inputs, job, series);
  inputs = ReadingStream(std::vector<char>()); // as large as the air
  AssimilationInput input;
  static_cast<MotionProblem&>(input) = std::move(job.Problem);
  const SolidsOn none;
  SilentMonitor silent;
  AirContext run(input, job.Options, none, parallel, silent);
  run.Search.HasSolids = job.HasSolids;
  WAFT_RETURN_IF_FAILED(run.Obstacles.Build(input.Obstacles));
  AirBodies bodies;
  AssimilationOutput judged;
  WAFT_RETURN_IF_FAILED(SetUpBodies(run, bodies, judged));
  const AirSampler air(series);
  std::atomic<bool> stop{ false };
  StopMonitor monitor(stop);
  ServeLoop(
    items, AtOnce * atOnce, parallel,
    [&](std::size_t o, StateArchive& result)
    {
      BodyProblem& body = bodies.Problems[o];
      BodyState& given = job.Bodies[o];
      SetTimes(given, body);
      if (!given.Slips.empty())
      {
        body.SetSlips(given.Slips);
      }
      std::vector<Vec3> path = std::move(given.Path);
      const FreeLanding landed = Act(run, air, job.Task, job.Iterations, body, path, monitor);
      BodyState state = StateOf(body, path);
      state.Landed = landed;
      state.TouchDowns.resize(given.TouchDowns.size()); // without the one that Landed tells
      state.LiftOffs.resize(given.LiftOffs.size());
      const BodyState& found = state;
      result.Values(found);
    },
    stop);
  return Result::Ok();
}

} // namespace waft
