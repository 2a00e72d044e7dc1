// SPDX-License-Identifier: BSD-3-Clause
#include "Base/TemporaryFolder.h"
#include "ThreadRanks.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

using namespace waft;

namespace
{

void Serialise(StateArchive& stream, std::vector<int>& list, std::string& text)
{
  stream.List(list);
  stream.Text(text);
}

} // namespace

TEST(Communicator, ExchangesWhatEachHasForEach)
{
  for (const int size : { 1, 2, 3, 5, 8 })
  {
    std::vector<std::vector<Communicator::Bytes>> got(size);
    EXPECT_TRUE(RunRanks(size,
                         [&](Communicator& ranks)
                         {
                           const int me = ranks.Rank();
                           std::vector<Communicator::Bytes> sent(size), received(size);
                           for (int r = 0; r < size; ++r)
                           {
                             // As many bytes as sender times receiver: some messages are empty.
                             sent[r].assign(me * r, static_cast<char>(10 * me + r));
                             received[r].resize(me * r);
                           }
                           ranks.Exchange(sent, received);
                           got[me] = received;
                         }));
    for (int to = 0; to < size; ++to)
    {
      for (int from = 0; from < size; ++from)
      {
        EXPECT_EQ(got[to][from], Communicator::Bytes(to * from, char(10 * from + to)));
      }
    }
  }
}

TEST(Communicator, BroadcastsFromAnyRankAndLetsRankZeroDecide)
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
                           wrong[me] += !ranks.Decide(me == 0);
                           wrong[me] += ranks.Decide(me != 0);
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

TEST(Communicator, WritesOneFileAndReadsItForAll)
{
  const test::TemporaryFolder folder;
  const std::string path = folder.File("rank-file");
  std::vector<std::vector<int>> lists(3, { 2, 7, 1, 8 });
  std::vector<std::string> texts(3, "twenty-eight");
  EXPECT_TRUE(RunRanks(3,
                       [&](Communicator& ranks)
                       {
                         std::unique_ptr<StateFileWriter> file;
                         if (ranks.IsFirst())
                         {
                           file = std::make_unique<StateFileWriter>(path);
                         }
                         RankFileStream stream(ranks, file.get(), false);
                         Serialise(stream, lists[ranks.Rank()], texts[ranks.Rank()]);
                         if (file)
                         {
                           EXPECT_TRUE(file->Commit());
                         }
                       }));
  std::vector<std::vector<int>> read(3);
  std::vector<std::string> words(3);
  std::vector<int> good(3, 0);
  const auto readOn = [&](Communicator& ranks)
  {
    std::unique_ptr<StateFileReader> file;
    if (ranks.IsFirst())
    {
      file = std::make_unique<StateFileReader>(path);
    }
    RankFileStream stream(ranks, file.get(), true);
    Serialise(stream, read[ranks.Rank()], words[ranks.Rank()]);
    good[ranks.Rank()] = stream.IsGood();
    int more = 0;
    stream.Value(more);
    good[ranks.Rank()] += stream.IsGood() ? 10 : 0; // nothing is left to be read
  };
  EXPECT_TRUE(RunRanks(3, readOn));
  EXPECT_EQ(read, lists);
  EXPECT_EQ(words, texts);
  EXPECT_EQ(good, std::vector<int>(3, 1));
}
