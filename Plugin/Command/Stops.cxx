// SPDX-License-Identifier: BSD-3-Clause
#include "Stops.h"

#include "Messages.h"
#include "Scene/SceneNode.h"

#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace waft::command
{
namespace
{

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds Grace{ 500 }; // until work that leaves nothing is ended
constexpr const char* ClearLine = "\r\033[K";

sigset_t StopSet()
{
  sigset_t set;
  ::sigemptyset(&set);
  for (const int number : { SIGINT, SIGTERM, SIGUSR1 })
  {
    ::sigaddset(&set, number);
  }
  return set;
}

struct Stops
{
  std::atomic<bool> IsAsked{ false };
  std::mutex Changing;
  std::string Words = "stopped before anything was begun";
  std::optional<Clock::time_point> Limit;
  std::function<void(const std::string&)> End;
};

Stops& TheStops()
{
  static Stops stops;
  return stops;
}

void ClearProgress()
{
  if (::isatty(STDERR_FILENO) != 0)
  {
    (void)!::write(STDERR_FILENO, ClearLine, 4);
  }
}

/// A second Ctrl-C means it.
void EndBy(int number)
{
  ClearProgress();
  std::signal(number, SIG_DFL);
  sigset_t set;
  ::sigemptyset(&set);
  ::sigaddset(&set, number);
  ::pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
  ::raise(number);
}

void Listen()
{
  const sigset_t set = StopSet();
  Stops& stops = TheStops();
  std::optional<Clock::time_point> asked;
  bool isInterrupted = false;
  while (true)
  {
    const timespec wait{ 0, 100000000 };
    const int number = ::sigtimedwait(&set, nullptr, &wait);
    const auto now = Clock::now();
    if (number == SIGINT && isInterrupted)
    {
      EndBy(number);
    }
    isInterrupted = isInterrupted || number == SIGINT;
    if (number > 0)
    {
      stops.IsAsked = true;
      asked = asked.value_or(now);
    }
    const std::unique_lock<std::mutex> lock(stops.Changing);
    if (stops.Limit && now >= *stops.Limit)
    {
      asked = asked.value_or(*stops.Limit);
    }
    if (asked && !stops.Words.empty() && now >= *asked + Grace)
    {
      ClearProgress();
      if (stops.End)
      {
        stops.End(stops.Words);
      }
      ::_exit(StoppedEarly);
    }
  }
}

/// A text without figures, which change all the time.
std::string WithoutFigures(const std::string& text)
{
  std::string rest;
  for (const char letter : text)
  {
    rest += std::string("0123456789.,+-").find(letter) == std::string::npos ? std::string(1, letter)
                                                                            : std::string();
  }
  return rest;
}

} // namespace

void EndStopsBy(const std::string& words, double timeLimit,
                std::function<void(const std::string&)> end)
{
  Stops& stops = TheStops();
  {
    const std::lock_guard<std::mutex> lock(stops.Changing);
    stops.Words = words;
    stops.End = std::move(end);
    if (timeLimit > 0.0)
    {
      stops.Limit = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                     std::chrono::duration<double>(std::min(timeLimit, 1e9)));
    }
  }
  static std::once_flag once;
  std::call_once(once, [] { std::thread(Listen).detach(); });
}

bool IsStopped()
{
  return TheStops().IsAsked;
}

ShownProgress::ShownProgress(bool isJson) :
  IsJson(isJson), IsLine(!IsQuiet() && ::isatty(STDERR_FILENO) != 0)
{
}

ShownProgress::~ShownProgress()
{
  if (this->IsLine)
  {
    ClearProgress();
  }
}

void ShownProgress::Begin(ChainStage stage)
{
  this->Stage = TraitsOf(stage).Word;
}

void ShownProgress::Keep()
{
  Stops& stops = TheStops();
  const std::lock_guard<std::mutex> lock(stops.Changing);
  stops.Words.clear();
}

void ShownProgress::Write()
{
  this->Stage.clear();
  this->Last = {};
  this->Tick(this->Done, "writing the results");
}

void ShownProgress::Report(double fraction, const std::string& text)
{
  this->Done = std::max(this->Done, std::min(fraction, 1.0));
  if (this->IsJson)
  {
    const SceneJson line = { { "fraction", std::round(1e4 * this->Done) / 1e4 }, { "text", text } };
    Tell(line.dump(-1, ' ', true, SceneJson::error_handler_t::replace));
  }
}

bool ShownProgress::Tick(double fraction, const std::string& text)
{
  const auto now = Clock::now();
  if (now - this->Last >= std::chrono::milliseconds(200))
  {
    this->Last = now;
    const std::string told = WithoutFigures(text);
    if (!told.empty() && told != this->Told && !this->Stage.empty())
    {
      this->Told = told;
      Say("waft: " + this->Stage + ": " + text, Message::Detail);
    }
    this->Report(fraction, this->Stage.empty() ? text
                           : text.empty()      ? this->Stage
                                               : this->Stage + ": " + text);
    if (this->IsLine)
    {
      char percent[16];
      std::snprintf(percent, sizeof(percent), " %3.0f %%  ", 100.0 * this->Done);
      const std::string line = ClearLine + Line(this->Stage + percent + text).substr(0, 104);
      (void)!::write(STDERR_FILENO, line.data(), line.size());
    }
  }
  const std::chrono::duration<double> passed = now - this->Start;
  return !IsStopped() && (this->Limit <= 0.0 || passed.count() < this->Limit);
}

} // namespace waft::command
