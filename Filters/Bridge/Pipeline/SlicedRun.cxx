// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Pipeline/SlicedRun.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

namespace waft
{

namespace
{

using Clock = std::chrono::steady_clock;
constexpr auto BetweenMessages = std::chrono::milliseconds(20); // of one text

} // namespace

/// Caller and work take turns.
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
  void Resume(bool goesOn)
  {
    std::unique_lock<std::mutex> lock(this->Mutex);
    this->GoesOn = this->GoesOn && goesOn;
    this->IsWorkersTurn = true;
    if (!this->Worker.joinable())
    {
      this->Worker = std::thread([this] { this->Main(); });
    }
    this->Turned.notify_all();
    this->Turned.wait(lock, [this] { return !this->IsWorkersTurn; });
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
    this->IsWorkersTurn = false;
    this->Turned.notify_all();
  }
  bool Tick(double fraction, const std::string& text) override
  {
    const Clock::time_point now = Clock::now();
    if (text == this->Text && now - this->Reported < BetweenMessages)
    {
      return this->GoesOn; // written in the caller's turns alone
    }
    this->Reported = now;
    std::unique_lock<std::mutex> lock(this->Mutex);
    this->Fraction = fraction;
    this->Text = text;
    this->IsWorkersTurn = false;
    this->Turned.notify_all();
    this->Turned.wait(lock, [this] { return this->IsWorkersTurn; });
    return this->GoesOn;
  }
  bool Publishes() const override { return true; }

  Work Do;
  std::thread Worker;
  std::mutex Mutex;
  std::condition_variable Turned;
  bool IsWorkersTurn = false;
  bool HasEnded = false;
  bool GoesOn = true;
  double Fraction = 0.0;
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

bool SlicedRun::GoOn(double seconds, Monitor& caller, Result& result)
{
  const std::chrono::duration<double> slice(seconds);
  const Clock::time_point begin = Clock::now();
  bool goesOn = true;
  do
  {
    this->Run->Resume(goesOn);
    if (this->Run->HasEnded)
    {
      const std::unique_ptr<Thread> ended = std::move(this->Run);
      if (ended->Thrown)
      {
        std::rethrow_exception(ended->Thrown);
      }
      result = ended->Outcome;
      return true;
    }
    goesOn = caller.Tick(this->Run->Fraction, this->Run->Text);
  } while (!goesOn || seconds <= 0.0 || Clock::now() - begin < slice);
  return false;
}

void SlicedRun::Discard()
{
  if (this->Run && this->Run->Worker.joinable())
  {
    while (!this->Run->HasEnded)
    {
      this->Run->Resume(false);
    }
  }
  this->Run.reset();
}

} // namespace waft
