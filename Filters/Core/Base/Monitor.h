// SPDX-License-Identifier: BSD-3-Clause
// Progress and abort, injected by the caller.
#pragma once

#include <string>

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
};

/// Never stops and says nothing.
class SilentMonitor : public Monitor
{
public:
  bool Tick(double, const std::string&) override { return true; }
};

} // namespace waft
