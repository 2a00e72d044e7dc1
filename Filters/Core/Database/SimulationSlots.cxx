// SPDX-License-Identifier: BSD-3-Clause
#include "Database/SimulationSlots.h"

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

bool SimulationSlots::HasRoom() const
{
  return this->Slots.size() < static_cast<std::size_t>(this->Options.SimulationsAtOnce);
}

Result SimulationSlots::Begin(int simulation)
{
  Slot slot;
  slot.Simulation = simulation;
  slot.Run = std::make_unique<SimulationRun>();
  if (Result begun = slot.Run->Begin(this->Options, simulation); !begun)
  {
    return Named(simulation, begun);
  }
  this->Slots.push_back(std::move(slot));
  return Result::Ok();
}

Result SimulationSlots::Advance(long stepsElsewhere, const ParallelFor& parallelFor,
                                Monitor& monitor)
{
  const int steps = StepsOfSimulation(this->Options);
  long done = stepsElsewhere;
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
  for (const Slot& slot : this->Slots)
  {
    if (!slot.Outcome)
    {
      return Named(slot.Simulation, slot.Outcome);
    }
  }
  SlotMonitor last(turn, "Simulating");
  return last.Tick(0.0, "") ? Result::Ok() : Result::Stopped();
}

std::map<int, TracedSimulation> SimulationSlots::TakeWhole()
{
  std::map<int, TracedSimulation> whole;
  for (Slot& slot : this->Slots)
  {
    if (slot.StepsTaken == StepsOfSimulation(this->Options))
    {
      whole[slot.Simulation] = slot.Run->Finish();
      slot.Run.reset();
    }
  }
  this->Slots.erase(std::remove_if(this->Slots.begin(), this->Slots.end(),
                                   [](const Slot& slot) { return !slot.Run; }),
                    this->Slots.end());
  return whole;
}

} // namespace waft
