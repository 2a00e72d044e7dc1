// SPDX-License-Identifier: BSD-3-Clause
#include "Database/SimulationQueue.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

namespace waft
{

namespace
{

using Clock = std::chrono::steady_clock;

/// Slots advance by whole frames until this much time is over, then those that ended are replaced
/// and the caller is asked: simulations whose frames take longer do not hold the others up.
constexpr std::chrono::milliseconds Turn(50);

Result Named(int simulation, const Result& result)
{
  return Result::Error("simulation " + std::to_string(simulation) + ": " + result.Message());
}

/// What the simulations of a turn share. The caller's monitor is asked only from the caller's
/// thread, which may or may not take part.
struct TurnState
{
  Monitor& Caller;
  std::thread::id CallingThread;
  double AllSteps;
  std::atomic<long> StepsDone;
  std::atomic<bool> IsStopped{ false };
};

class SlotMonitor : public Monitor
{
public:
  SlotMonitor(TurnState& turn, std::string text) : Turn(turn), Text(std::move(text)) {}
  bool Tick(double, const std::string&) override
  {
    if (std::this_thread::get_id() == this->Turn.CallingThread &&
        !this->Turn.Caller.Tick(static_cast<double>(this->Turn.StepsDone) / this->Turn.AllSteps,
                                this->Text))
    {
      this->Turn.IsStopped = true;
    }
    return !this->Turn.IsStopped;
  }

private:
  TurnState& Turn;
  std::string Text;
};

} // namespace

SimulationQueue::SimulationQueue(const DatabaseOptions& options, const TracedFiles& files) :
  Options(options), Files(files)
{
}

Result SimulationQueue::FillSlots()
{
  // Those that are read from files wait to be handed out, too: no more of them than of the others.
  const auto most = static_cast<std::size_t>(this->Options.SimulationsAtOnce);
  while (this->Slots.size() < most && this->Whole.size() < most &&
         this->Started < this->Options.NumberOfSimulations)
  {
    const int simulation = this->Started++;
    TracedSimulation kept;
    if (this->Files.Read(simulation, kept))
    {
      this->Whole.emplace(simulation, std::move(kept));
      this->StepsDone += StepsOfSimulation(this->Options);
      continue;
    }
    Slot slot;
    slot.Simulation = simulation;
    slot.Run = std::make_unique<SimulationRun>();
    if (Result begun = slot.Run->Begin(this->Options, simulation); !begun)
    {
      return Named(simulation, begun);
    }
    this->Slots.push_back(std::move(slot));
  }
  return Result::Ok();
}

Result SimulationQueue::Advance(const ParallelFor& parallelFor, Monitor& monitor)
{
  const int steps = StepsOfSimulation(this->Options);
  long done = this->StepsDone;
  for (const Slot& slot : this->Slots)
  {
    done += slot.StepsTaken;
  }
  TurnState turn{ monitor,
                  std::this_thread::get_id(),
                  static_cast<double>(steps) * this->Options.NumberOfSimulations,
                  { done } };
  const auto advance = [&](Slot& slot)
  {
    const Clock::time_point end = Clock::now() + Turn;
    do
    {
      SlotMonitor inner(turn, "Simulation " + std::to_string(slot.Simulation + 1) + " of " +
                                std::to_string(this->Options.NumberOfSimulations) + ", frame " +
                                std::to_string(slot.StepsTaken + 1) + " of " +
                                std::to_string(steps));
      if (!inner.Tick(0.0, ""))
      {
        return;
      }
      slot.Outcome = slot.Run->Step(inner);
      if (!slot.Outcome || slot.Outcome.IsStopped())
      {
        return;
      }
      ++slot.StepsTaken;
      ++turn.StepsDone;
    } while (slot.StepsTaken < steps && Clock::now() < end);
  };
  parallelFor(this->Slots.size(),
              [&](std::size_t begin, std::size_t end)
              {
                for (std::size_t s = begin; s < end; ++s)
                {
                  advance(this->Slots[s]);
                }
              });
  SlotMonitor last(turn, "Simulating");
  const bool goesOn = last.Tick(0.0, "");
  const Result gathered = this->Gather();
  return gathered && !goesOn ? Result::Stopped() : gathered;
}

Result SimulationQueue::Gather()
{
  for (Slot& slot : this->Slots)
  {
    if (!slot.Outcome)
    {
      return Named(slot.Simulation, slot.Outcome);
    }
    if (slot.StepsTaken < StepsOfSimulation(this->Options))
    {
      continue;
    }
    TracedSimulation& whole = this->Whole[slot.Simulation] = slot.Run->Finish();
    slot.Run.reset();
    this->StepsDone += slot.StepsTaken;
    WAFT_RETURN_IF_FAILED(this->Files.Write(slot.Simulation, whole));
  }
  this->Slots.erase(std::remove_if(this->Slots.begin(), this->Slots.end(),
                                   [](const Slot& slot) { return !slot.Run; }),
                    this->Slots.end());
  return Result::Ok();
}

Result SimulationQueue::Next(const ParallelFor& parallelFor, Monitor& monitor,
                             TracedSimulation& traced)
{
  while (true)
  {
    if (!this->IsStopped)
    {
      WAFT_RETURN_IF_FAILED(this->FillSlots());
    }
    if (this->Whole.count(this->HandedOut) > 0)
    {
      break;
    }
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

} // namespace waft
