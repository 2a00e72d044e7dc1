// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Run/TouchingBodies.h"

#include "Air/Drift/DriftTogether.h"

#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

namespace waft
{
namespace
{

// Fewer give way sooner than the others have heard of them.
constexpr std::ptrdiff_t FewestToDivide = 64;
// More are one part after the other, each with the others where they are: the equations of all
// would fill the memory, and wait for the slowest.
constexpr std::size_t MostTogether = 1024;
constexpr int IterationsOfPart = 16; // the air changes anyhow, or they give way once more

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

// By body: the middle of where it is near to others.
std::vector<Vec3> PlacesOf(const std::vector<DriftContact>& contacts, const AirBodies& bodies)
{
  std::vector<Vec3> places(bodies.Size(), Vec3::Zero());
  std::vector<std::size_t> counts(bodies.Size(), 0);
  for (const DriftContact& contact : contacts)
  {
    for (const std::size_t o : { contact.A, contact.B })
    {
      places[o] += bodies.Paths[o][static_cast<std::size_t>(contact.Frame)];
      ++counts[o];
    }
  }
  for (std::size_t o = 0; o < places.size(); ++o)
  {
    places[o] /= static_cast<double>(std::max<std::size_t>(counts[o], 1));
  }
  return places;
}

// Halves across the widest axis, and of these, until none has more than MostTogether: those that
// are near to each other are in one part but for few.
void AddParts(const std::vector<Vec3>& places, std::vector<std::size_t> whole,
              std::vector<std::vector<std::size_t>>& parts)
{
  if (whole.size() <= MostTogether)
  {
    parts.push_back(std::move(whole));
    return;
  }
  Box box = Box::Nothing();
  for (const std::size_t o : whole)
  {
    box.Add(places[o]);
  }
  int axis = 0;
  box.Size().maxCoeff(&axis);
  const auto middle = whole.begin() + static_cast<std::ptrdiff_t>(whole.size() / 2);
  std::nth_element(
    whole.begin(), middle, whole.end(),
    [&](std::size_t one, std::size_t other)
    { return std::pair(places[one][axis], one) < std::pair(places[other][axis], other); });
  AddParts(places, { whole.begin(), middle }, parts);
  AddParts(places, { middle, whole.end() }, parts);
}

bool SolvePart(const AirContext& run, const HalfSeries& air, const TouchingTask& task,
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

} // namespace

bool SolveTouching(const AirContext& run, const HalfSeries& air, const TouchingTask& task,
                   const std::vector<DriftContact>& contacts, AirBodies& bodies, Monitor& monitor)
{
  std::vector<std::size_t> moving;
  for (std::size_t o = 0; o < task.Which.size(); ++o)
  {
    if (task.Which[o])
    {
      moving.push_back(o);
    }
  }
  if (moving.size() <= MostTogether)
  {
    return SolvePart(run, air, task, contacts, bodies, monitor);
  }
  std::vector<std::vector<std::size_t>> parts;
  AddParts(PlacesOf(contacts, bodies), std::move(moving), parts);
  for (const std::vector<std::size_t>& part : parts)
  {
    TouchingTask own = task;
    own.Iterations = std::min(task.Iterations, IterationsOfPart);
    own.Which.assign(task.Which.size(), 0);
    for (const std::size_t o : part)
    {
      own.Which[o] = 1;
    }
    std::vector<DriftContact> near;
    std::copy_if(contacts.begin(), contacts.end(), std::back_inserter(near),
                 [&own](const DriftContact& contact)
                 { return own.Which[contact.A] || own.Which[contact.B]; });
    if (!SolvePart(run, air, own, near, bodies, monitor))
    {
      return false;
    }
  }
  return true;
}

Result ServeTouching(ReadingStream& inputs, Communicator& ranks, const ParallelFor& parallel,
                     AirElsewhere& elsewhere)
{
  TouchingTask task;
  std::vector<DriftContact> contacts;
  inputs.Values(task, contacts);
  WAFT_RETURN_IF_FAILED(elsewhere.Hear(inputs, parallel));
  inputs = ReadingStream(std::vector<char>()); // what it says is known now
  SilentMonitor silent;                        // the first rank's is asked
  (void)SolveHere(elsewhere.Run(), elsewhere.Air(), task, contacts, ranks, elsewhere.Bodies(),
                  silent);
  return Result::Ok();
}

} // namespace waft
