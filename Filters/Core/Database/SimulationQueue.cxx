// SPDX-License-Identifier: BSD-3-Clause
#include "Database/SimulationQueue.h"

#include <chrono>
#include <thread>
#include <utility>
#include <vector>

namespace waft
{

namespace
{

/// Between two looks at what others have, when there is nothing else to do.
constexpr std::chrono::milliseconds Pause(2);

/// All that a simulation depends on, and what its progress is measured by.
template <class Options>
void MoveJob(StateArchive& stream, Options& options)
{
  DatabaseOptions::VisitSimulations(stream, options);
  stream.Values(options.NumberOfSimulations);
}

MemoryStream JobOf(const DatabaseOptions& options)
{
  MemoryStream stream;
  MoveJob(stream, options);
  return stream;
}

} // namespace

SimulationQueue::SimulationQueue(const DatabaseOptions& options, const TracedFiles& files,
                                 Communicator& ranks) :
  Options(options),
  Files(files), MostWaiting(static_cast<std::size_t>(options.SimulationsAtOnce) * ranks.Size()),
  Others(ranks, SimulationKind, JobOf(options)), Slots(options)
{
}

std::int64_t SimulationQueue::Start()
{
  // Those that are read from files wait to be handed out, too: no more of them than of the others.
  while (this->Whole.size() < this->MostWaiting &&
         this->Started < this->Options.NumberOfSimulations)
  {
    const int simulation = this->Started++;
    TracedSimulation kept;
    if (!this->Files.Read(simulation, kept))
    {
      return simulation;
    }
    this->Whole.emplace(simulation, std::move(kept));
    this->StepsDone += StepsOfSimulation(this->Options);
  }
  return -1;
}

Result SimulationQueue::Keep(std::int64_t simulation, TracedSimulation traced)
{
  this->StepsDone += StepsOfSimulation(this->Options);
  const TracedSimulation& whole = this->Whole[simulation] = std::move(traced);
  return this->Files.Write(static_cast<int>(simulation), whole);
}

Result SimulationQueue::Advance(const ParallelFor& parallelFor, Monitor& monitor)
{
  while (this->Slots.HasRoom())
  {
    const std::int64_t simulation = this->Start();
    if (simulation < 0)
    {
      break;
    }
    WAFT_RETURN_IF_FAILED(this->Slots.Begin(static_cast<int>(simulation)));
  }
  if (this->Whole.count(this->HandedOut) > 0)
  {
    return Result::Ok(); // of a file
  }
  if (this->Slots.IsEmpty())
  {
    std::this_thread::sleep_for(Pause); // the others have the last ones
  }
  const Result advanced = this->Slots.Advance(this->StepsDone, parallelFor, monitor);
  for (auto& [simulation, traced] : this->Slots.TakeWhole())
  {
    WAFT_RETURN_IF_FAILED(this->Keep(simulation, std::move(traced)));
  }
  if (!advanced || advanced.IsStopped())
  {
    return advanced;
  }
  const auto next = [this](std::int64_t)
  {
    const std::int64_t simulation = this->Start();
    return simulation < 0 ? std::vector<std::int64_t>() : std::vector<std::int64_t>{ simulation };
  };
  return this->Others.Look(next,
                           [this](std::int64_t simulation, ReadingStream& stream)
                           {
                             TracedSimulation traced;
                             MoveTraced(stream, traced);
                             return this->Keep(simulation, std::move(traced));
                           });
}

Result SimulationQueue::Next(const ParallelFor& parallelFor, Monitor& monitor,
                             TracedSimulation& traced)
{
  while (this->Whole.count(this->HandedOut) == 0)
  {
    if (this->IsStopped)
    {
      return Result::Stopped();
    }
    const Result advanced = this->Advance(parallelFor, monitor);
    WAFT_RETURN_IF_FAILED(advanced);
    this->IsStopped = advanced.IsStopped();
  }
  auto next = this->Whole.find(this->HandedOut++);
  traced = std::move(next->second);
  this->Whole.erase(next);
  return Result::Ok();
}

Result ServeSimulations(ReadingStream& inputs, SharedItems& items, int atOnce,
                        const ParallelFor& parallelFor)
{
  DatabaseOptions options;
  MoveJob(inputs, options);
  options.SimulationsAtOnce = atOnce;
  WAFT_RETURN_IF_FAILED(options.Validate());
  SimulationSlots slots(options);
  SilentMonitor silent; // a turn is short
  while (!items.IsOver())
  {
    if (slots.HasRoom())
    {
      for (const std::int64_t simulation : items.Take(1, slots.IsEmpty()))
      {
        WAFT_RETURN_IF_FAILED(slots.Begin(static_cast<int>(simulation)));
      }
    }
    WAFT_RETURN_IF_FAILED(slots.Advance(0, parallelFor, silent));
    for (auto& [whole, traced] : slots.TakeWhole())
    {
      MemoryStream result;
      MoveTraced(result, traced);
      std::vector<ItemResult> one(1);
      one[0].Item = whole;
      one[0].Content = std::move(result.Content);
      items.Give(one);
    }
  }
  return Result::Ok();
}

} // namespace waft
