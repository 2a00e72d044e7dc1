// SPDX-License-Identifier: BSD-3-Clause
// Stops, the time limit, and progress of what the command does.
#pragma once

#include "Bridge/Run/FlyScene.h"

#include <chrono>
#include <functional>
#include <string>

namespace waft::command
{

/// SIGINT, SIGTERM and SIGUSR1, which HoldStops has wait, are taken from here on. How a stop ends
/// this process while the work cannot: with these words, at once, by exit status 4; empty words:
/// the work ends by itself. end: what is left to be done first.
void EndStopsBy(const std::string& words, double timeLimit,
                std::function<void(const std::string&)> end);
bool IsStopped();

/// Progress: a line on stderr where that is a terminal, or lines of JSON on stdout.
class ShownProgress : public FlightMonitor
{
public:
  explicit ShownProgress(bool isJson);
  ~ShownProgress() override;
  ShownProgress(const ShownProgress&) = delete;
  ShownProgress& operator=(const ShownProgress&) = delete;

  bool Tick(double fraction, const std::string& text) override;
  void Begin(ChainStage stage) override;
  void Keep() override;
  void Write() override;
  void Report(double fraction, const std::string& text);
  /// Ticks are false after so many seconds; 0: no limit.
  void LimitTime(double seconds) { this->Limit = seconds; }

private:
  std::chrono::steady_clock::time_point Last{};
  std::string Stage, Told;
  std::chrono::steady_clock::time_point Start = std::chrono::steady_clock::now();
  double Done = 0.0, Limit = 0.0;
  bool IsJson, IsLine;
};

} // namespace waft::command
