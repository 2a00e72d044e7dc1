// SPDX-License-Identifier: BSD-3-Clause
#include "ThreadRanks.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

using namespace waft;

namespace
{

void Serialise(StateArchive& stream, std::vector<int>& list, std::string& text)
{
  stream.List(list);
  stream.Text(text);
}

} // namespace

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
                         Serialise(stream, lists[ranks.Rank()], texts[ranks.Rank()]);
                       }));
  for (int r = 0; r < 3; ++r)
  {
    EXPECT_EQ(lists[r], (std::vector<int>{ 3, 1, 4 }));
    EXPECT_EQ(texts[r], "fifteen");
  }
}

TEST(Communicator, StreamsBetweenTwo)
{
  std::vector<int> list;
  std::string text;
  EXPECT_TRUE(RunRanks(3,
                       [&](Communicator& ranks)
                       {
                         if (ranks.IsFirst())
                         {
                           PeerStream stream(ranks, 2, true);
                           Serialise(stream, list, text);
                         }
                         else if (ranks.Rank() == 2)
                         {
                           std::vector<int> sent{ 2, 7, 1, 8 };
                           std::string words; // of no bytes
                           PeerStream stream(ranks, 0, false);
                           Serialise(stream, sent, words);
                         }
                       }));
  EXPECT_EQ(list, (std::vector<int>{ 2, 7, 1, 8 }));
  EXPECT_EQ(text, "");
}
