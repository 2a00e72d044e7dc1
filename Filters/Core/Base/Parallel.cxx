// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Parallel.h"

#include <algorithm>
#include <thread>
#include <vector>

namespace waft
{

ParallelFor ThreadedFor(int numberOfThreads)
{
  return
    [numberOfThreads](std::size_t count, const std::function<void(std::size_t, std::size_t)>& body)
  {
    const std::size_t threads = std::max<std::size_t>(1, numberOfThreads);
    std::vector<std::thread> pool;
    for (std::size_t t = 1; t < threads; ++t)
    {
      pool.emplace_back([&body, count, threads, t]
                        { body(count * t / threads, count * (t + 1) / threads); });
    }
    body(0, count / threads);
    for (std::thread& thread : pool)
    {
      thread.join();
    }
  };
}

} // namespace waft
