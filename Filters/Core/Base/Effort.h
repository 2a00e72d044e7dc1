// SPDX-License-Identifier: BSD-3-Clause
// What work takes.
#pragma once

#include <ctime>
#include <sys/resource.h>

namespace waft
{

struct Effort
{
  double Seconds = 0.0;   // by the clock
  double Processor = 0.0; // s, of all threads of the process
  double Thread = 0.0;    // s, of the thread that does it: of what others could not help with
  double PeakMB = 0.0;    // the most memory that the process had, when the work ended

  /// Of all that was done since the process began, or a moment was taken.
  static Effort Now()
  {
    const auto secondsOf = [](clockid_t clock)
    {
      timespec time{};
      ::clock_gettime(clock, &time);
      return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    };
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return { secondsOf(CLOCK_MONOTONIC), secondsOf(CLOCK_PROCESS_CPUTIME_ID),
             secondsOf(CLOCK_THREAD_CPUTIME_ID), static_cast<double>(usage.ru_maxrss) / 1024.0 };
  }
  Effort Since(const Effort& begin) const
  {
    return { this->Seconds - begin.Seconds, this->Processor - begin.Processor,
             this->Thread - begin.Thread, this->PeakMB };
  }
};

} // namespace waft
