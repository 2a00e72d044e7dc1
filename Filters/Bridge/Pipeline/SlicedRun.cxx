// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Pipeline/SlicedRun.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

namespace waft
{

namespace
{

using Clock = std::chrono::steady_clock;
constexpr auto BetweenMessages = std::chrono::milliseconds(20); // of one text

} // namespace

/// Caller and work take turns, but where the work was let go.
struct SlicedRun::Thread : Monitor
{
  explicit Thread(Work work) : Do(std::move(work)) {}
  ~Thread() override
  {
    if (this->Worker.joinable())
    {
      this->Worker.join();
    }
  }

  // The caller's side.

  /// Waits until the work is held, which it is no more meanwhile; true when it has ended.
  bool Resume(bool goesOn)
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    this->GoesOn = this->GoesOn && goesOn;
    this->IsFree = false;
    this->IsAwaited = true;
    this->GiveTurn();
    if (!this->Worker.joinable())
    {
      this->Worker = std::thread([this] { this->Main(); });
    }
    this->Turned.wait(lock, [this] { return !this->IsWorkersTurn; });
    this->IsAwaited = false;
    return this->HasEnded;
  }
  void Free(bool isFree)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->IsFree = isFree;
    if (isFree && !this->HasArrived && this->Worker.joinable())
    {
      this->GiveTurn();
    }
  }
  State Now()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    return this->HasArrived ? State::Arrived : this->IsWorkersTurn ? State::Beside : State::Held;
  }
  Progress SoFar()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    Progress progress = this->Reached;
    if (this->IsWorkersTurn)
    {
      progress.Seconds += std::chrono::duration<double>(Clock::now() - this->TurnBegan).count();
    }
    return progress;
  }

  // The work's side.

  void Main()
  {
    try
    {
      this->Outcome = this->Do(*this);
    }
    catch (...)
    {
      this->Thrown = std::current_exception();
    }
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->HasEnded = true;
    this->HasArrived = true;
    this->EndTurn();
  }
  bool Tick(double fraction, const std::string& text) override
  {
    const Clock::time_point now = Clock::now();
    if (text == this->Text && now - this->Reported < BetweenMessages)
    {
      return this->GoesOn;
    }
    this->Reported = now;
    this->Text = text;
    std::unique_lock<std::mutex> lock(this->Mutex);
    this->Reached.Done = fraction;
    this->Reached.Text = text;
    if (!this->IsFree)
    {
      this->EndTurn();
      this->Turned.wait(lock, [this] { return this->IsWorkersTurn; });
    }
    return this->GoesOn;
  }
  bool Publishes() const override { return true; }
  void Rejoin()
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    if (!this->IsAwaited)
    {
      this->HasArrived = true;
      this->EndTurn();
      this->Turned.wait(lock, [this] { return this->IsAwaited && this->IsWorkersTurn; });
    }
  }

  // Of either, with the mutex.

  void GiveTurn()
  {
    if (!this->IsWorkersTurn && !this->HasEnded)
    {
      this->IsWorkersTurn = true;
      this->TurnBegan = Clock::now();
    }
    this->Turned.notify_all();
  }
  void EndTurn()
  {
    this->IsWorkersTurn = false;
    this->Reached.Seconds += std::chrono::duration<double>(Clock::now() - this->TurnBegan).count();
    this->Turned.notify_all();
  }

  Work Do;
  std::thread Worker;
  std::mutex Mutex; // of what follows
  std::condition_variable Turned;
  bool IsWorkersTurn = false;
  bool IsAwaited = false; // the caller waits for the work
  bool IsFree = false;    // the work goes on where it ticks
  bool HasArrived = false;
  bool HasEnded = false;
  std::atomic<bool> GoesOn{ true };
  Clock::time_point TurnBegan;
  Progress Reached;
  // The work's own until it has ended.
  std::string Text;
  Clock::time_point Reported;
  Result Outcome = Result::Ok();
  std::exception_ptr Thrown;
};

SlicedRun::SlicedRun() = default;

SlicedRun::~SlicedRun()
{
  this->Discard();
}

void SlicedRun::Begin(Work work)
{
  this->Discard();
  this->Run = std::make_unique<Thread>(std::move(work));
}

SlicedRun::State SlicedRun::Now() const
{
  return this->Run ? this->Run->Now() : State::None;
}

SlicedRun::Progress SlicedRun::SoFar() const
{
  return this->Run ? this->Run->SoFar() : Progress();
}

bool SlicedRun::GoOn(double seconds, Monitor& caller, Result& result)
{
  const std::chrono::duration<double> slice(seconds);
  const Clock::time_point begin = Clock::now();
  bool goesOn = true;
  do
  {
    if (this->Run->Resume(goesOn))
    {
      const std::unique_ptr<Thread> ended = std::move(this->Run);
      if (ended->Thrown)
      {
        std::rethrow_exception(ended->Thrown);
      }
      result = ended->Outcome;
      return true;
    }
    const Progress progress = this->SoFar();
    goesOn = caller.Tick(progress.Done, progress.Text);
  } while (!goesOn || seconds <= 0.0 || Clock::now() - begin < slice);
  return false;
}

void SlicedRun::LetGo()
{
  if (this->Run)
  {
    this->Run->Free(true);
  }
}

void SlicedRun::Hold()
{
  if (this->Run)
  {
    this->Run->Free(false);
  }
}

void SlicedRun::Rejoin()
{
  if (this->Run)
  {
    this->Run->Rejoin();
  }
}

void SlicedRun::Discard()
{
  if (this->Run && this->Run->Worker.joinable())
  {
    while (!this->Run->Resume(false))
    {
    }
  }
  this->Run.reset();
}

} // namespace waft
