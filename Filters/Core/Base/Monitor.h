// SPDX-License-Identifier: BSD-3-Clause
// Progress and abort, injected by the caller.
#pragma once

#include <atomic>
#include <mutex>
#include <shared_mutex>
#include <string>
#include <thread>
#include <utility>

namespace waft
{

/// A kernel calls Tick at least every 0.2 s of work, from the thread that called the kernel.
class Monitor
{
public:
  virtual ~Monitor() = default;
  /// fraction: 0..1 of this kernel; text: a short sentence. Returns false to ask the kernel to
  /// stop.
  virtual bool Tick(double fraction, const std::string& text) = 0;
  /// Whether what there is so far is published during a Tick. A kernel that has an output for it
  /// then writes there, from the thread that ticks alone.
  virtual bool Publishes() const { return false; }
};

/// A part of a kernel's work, from `begin` to `end` of the whole. May be asked from any thread: the
/// whole is asked from the thread that made it; the others wait as long as that takes, since work
/// may be held meanwhile, and hear what it said. A fraction below 0 leaves the progress where it
/// is.
class PartMonitor : public Monitor
{
public:
  /// text: said instead of the part's own, unless it is empty.
  PartMonitor(Monitor& whole, double begin, double end, std::string text = {}) :
    Whole(whole), Begin(begin), End(end), Text(std::move(text))
  {
  }
  bool Tick(double fraction, const std::string& text) override
  {
    if (std::this_thread::get_id() == this->Thread)
    {
      this->Fraction = fraction < 0.0 ? this->Fraction : fraction;
      const double whole = this->Begin + this->Fraction * (this->End - this->Begin);
      const std::unique_lock<std::shared_mutex> hold(this->Asking);
      if (!this->Whole.Tick(whole, this->Text.empty() ? text : this->Text))
      {
        this->IsStopped = true;
      }
    }
    else
    {
      const std::shared_lock<std::shared_mutex> wait(this->Asking);
    }
    return !this->IsStopped;
  }
  bool Publishes() const override { return this->Whole.Publishes(); }

private:
  Monitor& Whole;
  double Begin, End;
  std::string Text;
  double Fraction = 0.0;
  std::thread::id Thread = std::this_thread::get_id();
  std::atomic<bool> IsStopped{ false };
  std::shared_mutex Asking; // held by the thread that asks the whole
};

/// Never stops and says nothing.
class SilentMonitor : public Monitor
{
public:
  bool Tick(double, const std::string&) override { return true; }
};

} // namespace waft
