// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/TouchingBodies.h"

#include "Air/Drift/DriftTogether.h"

#include <algorithm>
#include <memory>

namespace waft
{
namespace
{

// Fewer give way sooner than the others have heard of them.
constexpr std::ptrdiff_t FewestToDivide = 64;

// Those that may move, among the others.
std::vector<TogetherBody> Together(const AirContext& run, const AirSampler& air,
                                   const TouchingTask& task, const AirBodies& bodies)
{
  std::vector<TogetherBody> together(bodies.Size());
  const auto setUp = [&](std::size_t o)
  {
    TogetherBody& body = together[o];
    body.Weights = task.Weights;
    body.Weights.Barrier = task.Barriers.empty() ? body.Weights.Barrier : task.Barriers[o];
    if (task.Which[o] && !bodies.IsKept(o))
    {
      body.Problem = std::make_unique<DriftProblem>(bodies.Problems[o].In(air));
      if (task.HoldsToBalls && !bodies.Problems[o].HoldToBalls(bodies.Paths[o], *body.Problem))
      {
        body.Problem.reset();
      }
    }
  };
  run.Parallel(bodies.Size(),
               [&](std::size_t begin, std::size_t end)
               {
                 for (std::size_t o = begin; o < end; ++o)
                 {
                   setUp(o);
                 }
               });
  return together;
}

/// With all others that do the same.
bool SolveHere(const AirContext& run, const HalfSeries& series, const TouchingTask& task,
               const std::vector<DriftContact>& contacts, Communicator& ranks, AirBodies& bodies,
               Monitor& monitor)
{
  const AirSampler air(series);
  return SolveTogether(Together(run, air, task, bodies), contacts, air, task.Weights.Contact,
                       task.Iterations, run.Parallel, ranks, monitor, bodies.Paths);
}

} // namespace

bool SolveTouching(const AirContext& run, const HalfSeries& air, const TouchingTask& task,
                   const std::vector<DriftContact>& contacts, AirBodies& bodies, Monitor& monitor)
{
  SingleRank alone;
  Communicator* ranks = run.Input.Ranks;
  if (ranks == nullptr || ranks->Size() == 1 ||
      std::count(task.Which.begin(), task.Which.end(), 1) < FewestToDivide)
  {
    return SolveHere(run, air, task, contacts, alone, bodies, monitor);
  }
  MemoryStream job;
  job.Values(task, contacts);
  const bool isNewAir = TellRun(run, air, bodies, job);
  const WorkSharing others(*ranks, TouchingKind, job);
  if (isNewAir)
  {
    SendAir(air, *ranks);
  }
  job = MemoryStream(); // which they have now
  return SolveHere(run, air, task, contacts, *ranks, bodies, monitor);
}

Result ServeTouching(ReadingStream& inputs, Communicator& ranks, const ParallelFor& parallel,
                     AirElsewhere& elsewhere)
{
  TouchingTask task;
  std::vector<DriftContact> contacts;
  inputs.Values(task, contacts);
  WAFT_RETURN_IF_FAILED(elsewhere.Hear(inputs, parallel));
  inputs = ReadingStream(std::vector<char>()); // as large as the air
  SilentMonitor silent;                        // the first rank's is asked
  (void)SolveHere(elsewhere.Run(), elsewhere.Air(), task, contacts, ranks, elsewhere.Bodies(),
                  silent);
  return Result::Ok();
}

} // namespace waft
