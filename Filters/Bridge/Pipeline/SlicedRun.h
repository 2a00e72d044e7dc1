// SPDX-License-Identifier: BSD-3-Clause
// Work on a thread of its own that is held where it ticks its monitor, whole and untouched, so that
// it comes to the same bits as work that is never held.
#pragma once

#include "Base/Monitor.h"
#include "Base/Result.h"

#include <functional>
#include <memory>
#include <string>

namespace waft
{

/// The work runs while GoOn waits for it and, after LetGo, by itself beside the caller; at other
/// times it is held, and what it writes may be read. Its monitor is asked in the caller's thread,
/// within GoOn; by itself it goes on unasked.
class SlicedRun
{
public:
  using Work = std::function<Result(Monitor& monitor)>;

  enum class State
  {
    None,   // there is no work
    Held,   // it waits
    Beside, // it goes on by itself, to its next tick at least
    Arrived // it waits in Rejoin, or has ended: the next GoOn takes it at once
  };

  struct Progress
  {
    double Done = 0.0; // 0 to 1
    std::string Text;
    double Seconds = 0.0; // that it has worked, those in which it was held left out
  };

  SlicedRun();
  /// Discards.
  ~SlicedRun();
  SlicedRun(const SlicedRun&) = delete;
  SlicedRun& operator=(const SlicedRun&) = delete;

  /// Discards what there is; the work starts with GoOn.
  void Begin(Work work);
  /// Whether there is work whose end was not taken.
  bool HasWork() const { return this->Run != nullptr; }
  State Now() const;
  Progress SoFar() const;
  /// Lets the work run on until it ends, `seconds` are over (0: any number) and it ticks; its ticks
  /// are the caller's. False: it is held. True: it has ended with `result`, or with an exception,
  /// which is thrown here.
  bool GoOn(double seconds, Monitor& caller, Result& result);
  /// What is held goes on by itself.
  void LetGo();
  /// What goes on by itself waits at its next tick.
  void Hold();
  /// From within the work, before it writes what the caller may read at any time: waits until the
  /// caller is in GoOn. Nothing where there is no work, so that the same may be done at once.
  void Rejoin();
  /// Asks the work to stop and waits until it has.
  void Discard();

private:
  struct Thread;
  std::unique_ptr<Thread> Run;
};

} // namespace waft
