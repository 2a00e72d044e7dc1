// SPDX-License-Identifier: BSD-3-Clause
// Work that is divided over ranks: items of a job, handed out by rank 0 to the ranks that serve it,
// whose results come back to it. Threads are each rank's own affair.
#pragma once

#include "Base/Communicator.h"
#include "Base/ReadingStream.h"
#include "Base/Result.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace waft
{

/// One word between rank 0 and another, and what follows it.
struct WorkMessage
{
  enum class Word : std::int64_t
  {
    // of rank 0:
    Job,    // Item bytes of its kind and Size bytes of its inputs follow
    Item,   // to be worked on; Size more follow at once
    Send,   // what was announced is now received
    Over,   // nothing more of this job
    Free,   // no more jobs
            // of the others:
    Wants,  // items, so many at most
    Has,    // Item results in Size bytes, which are sent when they are asked for
    Failed, // Size bytes of a sentence, likewise
    Left    // the job, since it is over
  };
  Word Says;
  std::int64_t Item = 0, Size = 0;
};

/// A job as rank 0 has it. The other ranks are in Serve from before until after its lifetime. With
/// one rank it does nothing.
class WorkSharing
{
public:
  /// kind: one of those that the others know; inputs: all that they need to know of the job.
  WorkSharing(Communicator& ranks, const std::string& kind, const MemoryStream& inputs);
  WorkSharing(const WorkSharing&) = delete;
  WorkSharing& operator=(const WorkSharing&) = delete;
  /// The others drop what they are at.
  ~WorkSharing();

  /// Answers the others, quickly. next: gives so many items at most for another rank, none when
  /// there are none now. take: gets what came of one. Called every tenth of a second or so, more
  /// often where items are short: the others wait meanwhile.
  Result Look(const std::function<std::vector<std::int64_t>(std::int64_t most)>& next,
              const std::function<Result(std::int64_t, ReadingStream&)>& take);
  /// Items that others are at.
  int Away() const { return this->NumberAway; }

private:
  Communicator& Ranks;
  std::vector<std::int64_t> Wanted; // by rank: items that it waits for
  int NumberAway = 0;
};

/// Whether other ranks are at a job of this one, which is rank 0. Else they sleep, and their cores
/// are free.
bool OthersWork();

/// What came of an item.
struct ItemResult
{
  std::int64_t Item = 0;
  std::vector<char> Content;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Item...);
    visit(of.Content...);
  }
};

/// A job as another rank has it.
class SharedItems
{
public:
  explicit SharedItems(Communicator& ranks) : Ranks(ranks) {}

  /// The next items, so many at most. None when none have come yet; they are waited for when there
  /// is nothing else to do. None come once the job is over.
  std::vector<std::int64_t> Take(std::int64_t most, bool waits);
  /// What came of some, or why nothing did. All at once, since rank 0 looks only now and then.
  void Give(const std::vector<ItemResult>& results);
  void Fail(const std::string& sentence);
  bool IsOver();
  /// Until it is.
  void AwaitEnd();

private:
  struct Outcome
  {
    WorkMessage::Word Says;
    std::int64_t Number; // of results
    std::vector<char> Content;
  };
  void Announce(Outcome outcome);
  void AnnounceNext();
  void Hear(); // one message, waited for
  void Listen();

  Communicator& Ranks;
  std::vector<std::int64_t> Items;
  std::deque<Outcome> Results; // not sent yet, the first one announced
  bool HasAsked = false, MoreFollow = false, IsEnded = false;
};

/// What other ranks can do, by kind: works on items until there are none, and reports a failure by
/// its Result.
using WorkKinds = std::map<std::string, std::function<Result(ReadingStream&, SharedItems&)>>;

/// Works for rank 0, on all other ranks, until it calls Release.
void Serve(Communicator& ranks, const WorkKinds& kinds);
/// Lets the others go; on rank 0.
void Release(Communicator& ranks);

} // namespace waft
