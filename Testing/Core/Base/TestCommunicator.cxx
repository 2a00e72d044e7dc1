// SPDX-License-Identifier: BSD-3-Clause
#include "ThreadRanks.h"

#include <gtest/gtest.h>

#include <atomic>
#include <new>
#include <string>
#include <vector>

using namespace waft;

TEST(Communicator, BroadcastsFromAnyRankAndFindsTheLargest)
{
  for (const int size : { 1, 2, 3, 6 })
  {
    std::vector<int> wrong(size, 0);
    EXPECT_TRUE(RunRanks(size,
                         [&](Communicator& ranks)
                         {
                           const int me = ranks.Rank();
                           for (int from = 0; from < size; ++from)
                           {
                             int value = 100 + me;
                             ranks.Broadcast(&value, sizeof(value), from);
                             wrong[me] += value != 100 + from;
                           }
                           wrong[me] += ranks.Largest(-me * (me - 4.0)) !=
                                        (size > 2 ? 4.0 : (size == 2 ? 3.0 : 0.0));
                         }));
    EXPECT_EQ(wrong, std::vector<int>(size, 0)) << size;
  }
}

TEST(Communicator, BroadcastsStructuresByTheirStreams)
{
  std::vector<std::vector<int>> lists(3);
  std::vector<std::string> texts(3);
  lists[0] = { 3, 1, 4 };
  texts[0] = "fifteen";
  EXPECT_TRUE(RunRanks(3,
                       [&](Communicator& ranks)
                       {
                         BroadcastStream stream(ranks);
                         stream.Values(lists[ranks.Rank()], texts[ranks.Rank()]);
                       }));
  for (int r = 0; r < 3; ++r)
  {
    EXPECT_EQ(lists[r], (std::vector<int>{ 3, 1, 4 }));
    EXPECT_EQ(texts[r], "fifteen");
  }
}

TEST(Communicator, GivesAllTheResultOfTheFirst)
{
  for (const Result& own : { Result::Ok(), Result::Stopped(), Result::Error("no room") })
  {
    std::vector<Result> found(3);
    std::atomic<int> workers = 0;
    EXPECT_TRUE(RunRanks(3,
                         [&](Communicator& ranks)
                         {
                           found[ranks.Rank()] = ResultOfFirst(ranks,
                                                               [&]
                                                               {
                                                                 ++workers;
                                                                 return own;
                                                               });
                         }));
    EXPECT_EQ(workers.load(), 1);
    for (const Result& result : found)
    {
      EXPECT_EQ(bool(result), bool(own));
      EXPECT_EQ(result.IsStopped(), own.IsStopped());
      EXPECT_EQ(result.Message(), own.Message());
    }
  }
}

TEST(Communicator, LeavesNoneWaitingForAFirstThatThrows)
{
  std::vector<std::string> messages(3);
  EXPECT_TRUE(
    RunRanks(3,
             [&](Communicator& ranks)
             {
               try
               {
                 messages[ranks.Rank()] =
                   ResultOfFirst(ranks, []() -> Result { throw std::bad_alloc(); }).Message();
               }
               catch (const std::bad_alloc&)
               {
                 messages[ranks.Rank()] = "thrown";
               }
             }));
  EXPECT_EQ(messages, (std::vector<std::string>{ "thrown", "the first process has failed",
                                                 "the first process has failed" }));
}
