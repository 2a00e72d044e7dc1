// SPDX-License-Identifier: BSD-3-Clause
// Work that goes on in slices: between two of them it is held where it ticks its monitor, whole and
// untouched, so that it comes to the same bits as work that is never held.
#pragma once

#include "Base/Monitor.h"
#include "Base/Result.h"

#include <functional>
#include <memory>

namespace waft
{

/// The work has a thread of its own, which runs while GoOn waits for it, and at no other time: what
/// the work writes may be read between two slices. Its monitor is asked in the caller's thread.
class SlicedRun
{
public:
  using Work = std::function<Result(Monitor& monitor)>;

  SlicedRun();
  /// Discards.
  ~SlicedRun();
  SlicedRun(const SlicedRun&) = delete;
  SlicedRun& operator=(const SlicedRun&) = delete;

  /// Discards what there is; the work starts with GoOn.
  void Begin(Work work);
  /// Whether there is work that has not ended.
  bool IsHeld() const { return this->Run != nullptr; }
  /// Lets the work run on until it ends, `seconds` are over (0: any number) and it ticks; its ticks
  /// are the caller's. False: it is held. True: it has ended with `result`, or with an exception,
  /// which is thrown here.
  bool GoOn(double seconds, Monitor& caller, Result& result);
  /// Asks the work to stop and waits until it has.
  void Discard();

private:
  struct Thread;
  std::unique_ptr<Thread> Run;
};

} // namespace waft
