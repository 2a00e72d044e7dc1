// SPDX-License-Identifier: BSD-3-Clause
#include "Base/SharedLoop.h"
#include "ThreadRanks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <thread>

using namespace waft;

namespace
{

double ValueOf(double offset, std::size_t item)
{
  return offset + 1.0 / (1.0 + static_cast<double>(item));
}

Result Serve(ReadingStream& inputs, SharedItems& items)
{
  double offset = 0.0;
  int pause = 0;
  inputs.Values(offset, pause);
  if (offset < 0.0)
  {
    return Result::Error("expected an offset of 0 or more");
  }
  std::atomic<bool> stop{ false };
  ServeLoop(
    items, 3, ThreadedFor(2),
    [&](std::size_t item, StateArchive& result)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(pause));
      const double value = ValueOf(offset, item);
      result.Values(value);
    },
    stop);
  return Result::Ok();
}

struct Looped
{
  std::vector<double> Values = std::vector<double>(100, 0.0);
  int ByOthers = 0, Watched = 0;
  Result Outcome = Result::Ok();
};

/// Items take a while each [ms], so that all ranks have some and a stop comes before their end.
Looped Loop(int size, const std::vector<std::size_t>& which, double offset = 0.3,
            int stopAfter = 1000, int pause = 2)
{
  Looped found;
  std::atomic<bool> stop{ false };
  std::atomic<int> done{ 0 };
  SharedLoop loop;
  loop.Kind = "values";
  loop.Items = which;
  loop.Tell = [&](StateArchive& inputs) { inputs.Values(offset, pause); };
  loop.Work = [&](std::size_t item)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(pause));
    found.Values[item] = ValueOf(offset, item);
    ++done;
  };
  loop.Take = [&](std::size_t item, ReadingStream& result)
  {
    result.Values(found.Values[item]);
    ++found.ByOthers;
    ++done;
  };
  loop.Watch = [&] { stop = ++found.Watched >= stopAfter && done > 0; };
  loop.IsWatched = stopAfter < 1000;
  EXPECT_TRUE(RunRanks(size,
                       [&](Communicator& ranks)
                       {
                         if (!ranks.IsFirst())
                         {
                           waft::Serve(ranks, { { "values", Serve } });
                           return;
                         }
                         found.Outcome = RunShared(loop, &ranks, ThreadedFor(2), stop);
                         Release(ranks);
                       }));
  return found;
}

std::vector<std::size_t> Odd(std::size_t below)
{
  std::vector<std::size_t> items;
  for (std::size_t k = 1; k < below; k += 2)
  {
    items.push_back(k);
  }
  return items;
}

} // namespace

TEST(SharedLoop, FillsTheSlotsOfItsItemsOnAnyNumberOfRanks)
{
  const std::vector<std::size_t> items = Odd(77);
  const Looped one = Loop(1, items);
  EXPECT_EQ(one.Watched, 0);
  for (std::size_t k = 0; k < one.Values.size(); ++k)
  {
    EXPECT_EQ(one.Values[k], k % 2 == 1 && k < 77 ? ValueOf(0.3, k) : 0.0);
  }
  for (const int size : { 2, 3, 5 })
  {
    const Looped other = Loop(size, items);
    EXPECT_TRUE(other.Outcome) << other.Outcome.Message();
    EXPECT_EQ(other.Values, one.Values);
    EXPECT_GT(other.ByOthers, 0);
    EXPECT_GT(other.Watched, 0);
  }
}

TEST(SharedLoop, OfNoItemsOrOneAsksNobody)
{
  EXPECT_EQ(Loop(3, {}).Values, std::vector<double>(100, 0.0));
  const Looped single = Loop(3, { 4 });
  EXPECT_EQ(single.ByOthers, 0);
  EXPECT_EQ(single.Values[4], ValueOf(0.3, 4));
}

TEST(SharedLoop, StopsBeforeItsItemsAreDone)
{
  for (const int size : { 1, 3 })
  {
    const Looped found = Loop(size, Odd(100), 0.3, 2, 200);
    EXPECT_TRUE(found.Outcome);
    EXPECT_GE(found.Watched, 2);
    EXPECT_LT(std::count(found.Values.begin(), found.Values.end(), 0.0), 100);
    EXPECT_GT(std::count(found.Values.begin(), found.Values.end(), 0.0), 50);
  }
}

TEST(SharedLoop, SaysWhatAnotherRankFailedAt)
{
  EXPECT_EQ(Loop(3, Odd(100), -1.0).Outcome.Message(), "expected an offset of 0 or more");
}
