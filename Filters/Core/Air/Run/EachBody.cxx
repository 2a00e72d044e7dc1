// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/EachBody.h"

#include "Air/Drift/FreeLanding.h"
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
constexpr int AtOnce = 64; // bodies a thread of another rank, which then asks for more

void Act(const AirContext& run, const AirSampler& air, BodyTask task, int iterations,
         BodyProblem& body, std::vector<Vec3>& path, Monitor& monitor)
{
  FreeLanding landing;
  int gone = -1;
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
      gone = body.GoneFrom(path);
      if (landing.Frame >= 0 && (gone < 0 || landing.Frame < gone))
      {
        body.LandFreely(landing.Frame, landing.Place);
        SolveDrift(body.In(air), air, run.Search.Weights, LandingIterations, path);
      }
      break;
  }
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
  bool isNewAir = false;
  loop.Tell = [&](StateArchive& stream)
  {
    stream.Values(task, iterations);
    isNewAir = TellRun(run, series, bodies, stream);
  };
  loop.Send = [&](Communicator& ranks)
  {
    if (isNewAir)
    {
      SendAir(series, ranks);
    }
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
    SetState(std::move(state), bodies.Problems[o], bodies.Paths[o]);
    ++done;
  };
  loop.Watch = [&] { goesOn(done); };
  const bool isWorth = task == BodyTask::Seek || loop.Items.size() >= FewestToShare;
  const Result shared = RunShared(loop, isWorth ? run.Input.Ranks : nullptr, run.Parallel, stop);
  return !shared || !stop ? shared : Result::Stopped();
}

Result ServeBodies(ReadingStream& inputs, SharedItems& items, int atOnce,
                   const ParallelFor& parallel, AirElsewhere& elsewhere)
{
  BodyTask task = BodyTask::Seek;
  int iterations = 0;
  inputs.Values(task, iterations);
  WAFT_RETURN_IF_FAILED(elsewhere.Hear(inputs, parallel));
  inputs = ReadingStream(std::vector<char>()); // what it says is known now
  const AirContext& run = elsewhere.Run();
  AirBodies& bodies = elsewhere.Bodies();
  const AirSampler air(elsewhere.Air());
  std::atomic<bool> stop{ false };
  StopMonitor monitor(stop);
  ServeLoop(
    items, AtOnce * atOnce, parallel,
    [&](std::size_t o, StateArchive& result)
    {
      Act(run, air, task, iterations, bodies.Problems[o], bodies.Paths[o], monitor);
      const BodyState found = StateOf(bodies.Problems[o], bodies.Paths[o]);
      result.Values(found);
    },
    stop);
  return Result::Ok();
}

} // namespace waft
