// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

using namespace waft;

namespace
{

TEST(Parallel, CoversEachIndexOnce)
{
  for (const int threads : { 1, 2, 3, 8, 2 })
  {
    const ParallelFor loop = ThreadedFor(threads);
    for (const std::size_t count : { 0u, 1u, 2u, 7u, 1000u })
    {
      std::vector<int> times(count, 0);
      for (int k = 0; k < 50; ++k)
      {
        loop(count, [&](std::size_t begin, std::size_t end)
             { std::for_each(times.begin() + begin, times.begin() + end, [](int& t) { ++t; }); });
      }
      EXPECT_EQ(times, std::vector<int>(count, 50)) << threads << " threads";
    }
  }
}

// That so many run side by side: each waits for the others.
bool AreTogether(const ParallelFor& loop, int threads)
{
  using namespace std::chrono_literals;
  std::atomic<int> there{ 0 };
  std::atomic<bool> isLate{ false };
  loop(static_cast<std::size_t>(threads),
       [&](std::size_t begin, std::size_t end)
       {
         there += static_cast<int>(end - begin);
         const auto late = std::chrono::steady_clock::now() + 20s;
         while (there < threads && !isLate)
         {
           isLate = std::chrono::steady_clock::now() > late || end - begin > 1;
           std::this_thread::yield();
         }
       });
  return !isLate;
}

TEST(Parallel, TakesAsManyThreadsAsThereAreWhenALoopBegins)
{
  int threads = 2;
  const ParallelFor loop = ThreadedFor([&threads] { return threads; });
  EXPECT_TRUE(AreTogether(loop, 2));
  threads = 4;
  EXPECT_TRUE(AreTogether(loop, 4));
  threads = 1;
  const std::thread::id own = std::this_thread::get_id();
  loop(8, [&](std::size_t, std::size_t) { EXPECT_EQ(std::this_thread::get_id(), own); });
}

TEST(Parallel, CoversALoopWithinALoop)
{
  std::vector<std::vector<int>> times(9, std::vector<int>(11, 0));
  const ParallelFor loop = ThreadedFor(4);
  loop(times.size(),
       [&](std::size_t begin, std::size_t end)
       {
         for (std::size_t k = begin; k < end; ++k)
         {
           loop(times[k].size(),
                [&, k](std::size_t first, std::size_t last) {
                  std::for_each(times[k].begin() + first, times[k].begin() + last,
                                [](int& t) { ++t; });
                });
         }
       });
  EXPECT_EQ(times, std::vector<std::vector<int>>(9, std::vector<int>(11, 1)));
}

TEST(Parallel, CoversLoopsOfSeveralThreadsAtATime)
{
  constexpr std::size_t Count = 500;
  std::vector<std::vector<int>> times(4, std::vector<int>(Count, 0));
  std::vector<std::thread> callers;
  for (std::vector<int>& own : times)
  {
    callers.emplace_back(
      [&own]
      {
        for (int k = 0; k < 200; ++k)
        {
          ThreadedFor(3)(
            Count, [&](std::size_t begin, std::size_t end)
            { std::for_each(own.begin() + begin, own.begin() + end, [](int& t) { ++t; }); });
        }
      });
  }
  for (std::thread& caller : callers)
  {
    caller.join();
  }
  for (const std::vector<int>& own : times)
  {
    EXPECT_EQ(own, std::vector<int>(Count, 200));
  }
}

} // namespace
