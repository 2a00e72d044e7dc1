// SPDX-License-Identifier: BSD-3-Clause
// Threads, injected by the caller: serial by default, as vtkSMPTools is set in the wrappers.
#pragma once

#include <cstddef>
#include <functional>

namespace waft
{

/// Runs body(begin, end) over disjoint ranges that cover [0, count). The ranges' number and order
/// are not stated: results must not depend on them (write to slots of your own, sum afterwards in a
/// fixed order). Bodies do not throw.
using ParallelFor =
  std::function<void(std::size_t count, const std::function<void(std::size_t, std::size_t)>& body)>;

inline ParallelFor SerialFor()
{
  return [](std::size_t count, const std::function<void(std::size_t, std::size_t)>& body)
  {
    if (count > 0)
    {
      body(0, count);
    }
  };
}

/// A ParallelFor of std::threads that stay for the next loop. A loop within a loop, or beside that
/// of another thread, is serial.
ParallelFor ThreadedFor(int numberOfThreads);
/// The same by as many threads as there are when a loop begins.
ParallelFor ThreadedFor(const std::function<int()>& numberOfThreads);

} // namespace waft
