// SPDX-License-Identifier: BSD-3-Clause
#include "Base/SharedWork.h"
#include "ThreadRanks.h"

#include <gtest/gtest.h>

#include <new>
#include <string>
#include <thread>
#include <vector>

using namespace waft;

namespace
{

/// Squares of the items, one at a time and some at a time.
Result Squares(ReadingStream& inputs, SharedItems& items)
{
  std::int64_t offset = 0;
  inputs.Values(offset);
  std::int64_t most = 1;
  for (auto some = items.Take(most, true); !some.empty(); some = items.Take(most, true))
  {
    EXPECT_LE(static_cast<std::int64_t>(some.size()), most);
    std::vector<ItemResult> results;
    for (const std::int64_t item : some)
    {
      if (offset < 0 && item == 2)
      {
        return Result::Error("item 2: expected no offset below 0");
      }
      if (offset < -1)
      {
        throw std::bad_alloc();
      }
      MemoryStream result;
      std::vector<std::int64_t> squares(static_cast<std::size_t>(item) + 1, item * item + offset);
      result.Values(squares);
      results.push_back({ item, std::move(result.Content) });
    }
    items.Give(results);
    most = 4 - most;
  }
  return Result::Ok();
}

struct Gathered
{
  std::vector<std::vector<std::int64_t>> Squares;
  int ByOthers = 0;
  Result Outcome = Result::Ok();
};

/// By rank 0, which works on every item that no other one has taken, until so many are there.
Gathered Gather(Communicator& ranks, const std::string& kind, std::int64_t offset, int count,
                int enough)
{
  MemoryStream inputs;
  inputs.Values(offset);
  WorkSharing others(ranks, kind, inputs);
  Gathered found;
  found.Squares.resize(static_cast<std::size_t>(count));
  int started = 0, done = 0;
  while (found.Outcome && done < enough)
  {
    const auto next = [&](std::int64_t most)
    {
      std::vector<std::int64_t> some;
      while (started < count && static_cast<std::int64_t>(some.size()) < most)
      {
        some.push_back(started++);
      }
      return some;
    };
    found.Outcome = others.Look(next,
                                [&](std::int64_t item, ReadingStream& result)
                                {
                                  result.Values(found.Squares[item]);
                                  ++found.ByOthers;
                                  ++done;
                                  return Result::Ok();
                                });
    if (ranks.Size() == 1)
    {
      found.Squares[started].assign(started + 1, started * started + offset);
      ++started;
      ++done;
    }
    std::this_thread::yield();
  }
  return found;
}

/// Rank 0's of several jobs, one after the other.
std::vector<Gathered> OnRanks(int size,
                              const std::function<std::vector<Gathered>(Communicator&)>& first)
{
  std::vector<Gathered> found;
  EXPECT_TRUE(RunRanks(size,
                       [&](Communicator& ranks)
                       {
                         if (ranks.IsFirst())
                         {
                           found = first(ranks);
                           Release(ranks);
                         }
                         else
                         {
                           Serve(ranks, { { "squares", Squares } });
                         }
                       }));
  return found;
}

} // namespace

TEST(SharedWork, ComesTogetherFromAnyNumberOfRanks)
{
  for (const int size : { 1, 2, 3, 5 })
  {
    const auto found = OnRanks(size,
                               [](Communicator& ranks)
                               {
                                 return std::vector<Gathered>{ Gather(ranks, "squares", 3, 40, 40),
                                                               Gather(ranks, "squares", 4, 2, 2) };
                               });
    ASSERT_EQ(found.size(), 2u);
    for (std::int64_t job = 0; job < 2; ++job)
    {
      EXPECT_TRUE(found[job].Outcome) << found[job].Outcome.Message();
      EXPECT_EQ(found[job].ByOthers, size == 1 ? 0 : int(found[job].Squares.size()));
      for (std::int64_t k = 0; k < std::int64_t(found[job].Squares.size()); ++k)
      {
        EXPECT_EQ(found[job].Squares[k], std::vector<std::int64_t>(k + 1, k * k + 3 + job));
      }
    }
  }
}

TEST(SharedWork, TellsWhetherOthersWork)
{
  const MemoryStream nothing;
  const auto isTold = [&](Communicator& ranks)
  {
    EXPECT_FALSE(OthersWork());
    {
      const WorkSharing others(ranks, "squares", nothing);
      EXPECT_EQ(OthersWork(), ranks.Size() > 1);
    }
    EXPECT_FALSE(OthersWork());
    return std::vector<Gathered>();
  };
  OnRanks(1, isTold);
  OnRanks(3, isTold);
}

TEST(SharedWork, EndsBeforeAllIsDone)
{
  // The ranks that still have items, or have announced results, are left free for the next job.
  for (int round = 0; round < 20; ++round)
  {
    const auto found =
      OnRanks(4,
              [](Communicator& ranks)
              {
                return std::vector<Gathered>{ Gather(ranks, "squares", 0, 1000, 5),
                                              Gather(ranks, "squares", 0, 1000, 0),
                                              Gather(ranks, "squares", 0, 10, 10) };
              });
    EXPECT_GE(found[0].ByOthers, 5);
    EXPECT_EQ(found[2].ByOthers, 10);
    EXPECT_EQ(found[2].Squares[9], std::vector<std::int64_t>(10, 81));
  }
}

TEST(SharedWork, FailsAsAWholeAndGoesOnWithAnotherJob)
{
  const auto found = OnRanks(3,
                             [](Communicator& ranks)
                             {
                               return std::vector<Gathered>{ Gather(ranks, "squares", -1, 40, 40),
                                                             Gather(ranks, "squares", -2, 40, 40),
                                                             Gather(ranks, "cubes", 0, 40, 40),
                                                             Gather(ranks, "squares", 0, 3, 3) };
                             });
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0].Outcome.Message(), "item 2: expected no offset below 0");
  EXPECT_EQ(found[1].Outcome.Message(), "std::bad_alloc");
  EXPECT_EQ(found[2].Outcome.Message(), "a process knows nothing of a job that is shared: expected "
                                        "processes of one Waft");
  EXPECT_TRUE(found[3].Outcome);
}
