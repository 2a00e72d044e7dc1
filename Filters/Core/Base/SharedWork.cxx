// SPDX-License-Identifier: BSD-3-Clause
#include "Base/SharedWork.h"

#include <atomic>
#include <exception>
#include <utility>

namespace waft
{
namespace
{

using Word = WorkMessage::Word;

std::atomic<int> JobsOfOthers{ 0 };

void Say(Communicator& ranks, int rank, Word word, std::int64_t item = 0, std::size_t size = 0)
{
  const WorkMessage message{ word, item, static_cast<std::int64_t>(size) };
  ranks.SendReceive(rank, &message, sizeof(message), nullptr, 0);
}

WorkMessage HearFrom(Communicator& ranks, int rank)
{
  WorkMessage message{ Word::Over };
  ranks.SendReceive(rank, nullptr, 0, &message, sizeof(message));
  return message;
}

std::vector<char> BytesFrom(Communicator& ranks, int rank, std::int64_t size)
{
  std::vector<char> bytes(static_cast<std::size_t>(size));
  ranks.SendReceive(rank, nullptr, 0, bytes.data(), bytes.size());
  return bytes;
}

Result Work(Communicator& ranks, const WorkMessage& job, const WorkKinds& kinds, SharedItems& items)
{
  const std::vector<char> name = BytesFrom(ranks, 0, job.Item);
  ReadingStream inputs(BytesFrom(ranks, 0, job.Size));
  const auto kind = kinds.find(std::string(name.begin(), name.end()));
  if (kind == kinds.end())
  {
    return Result::Error(
      "a process knows nothing of a job that is shared: expected processes of one Waft");
  }
  try
  {
    return kind->second(inputs, items);
  }
  catch (const std::exception& error)
  {
    return Result::Error(error.what());
  }
}

} // namespace

WorkSharing::WorkSharing(Communicator& ranks, const std::string& kind, const MemoryStream& inputs) :
  Ranks(ranks), Wanted(static_cast<std::size_t>(ranks.Size()), 0)
{
  JobsOfOthers += ranks.Size() > 1 ? 1 : 0;
  for (int r = 1; r < ranks.Size(); ++r)
  {
    Say(ranks, r, Word::Job, static_cast<std::int64_t>(kind.size()), inputs.Content.size());
    ranks.SendReceive(r, kind.data(), kind.size(), nullptr, 0);
    ranks.SendReceive(r, inputs.Content.data(), inputs.Content.size(), nullptr, 0);
  }
}

WorkSharing::~WorkSharing()
{
  for (int r = 1; r < this->Ranks.Size(); ++r)
  {
    Say(this->Ranks, r, Word::Over);
  }
  for (int r = 1; r < this->Ranks.Size(); ++r)
  {
    while (HearFrom(this->Ranks, r).Says != Word::Left)
    {
      // What it said before it heard that all is over.
    }
  }
  JobsOfOthers -= this->Ranks.Size() > 1 ? 1 : 0;
}

bool OthersWork()
{
  return JobsOfOthers > 0;
}

Result WorkSharing::Look(const std::function<std::vector<std::int64_t>(std::int64_t most)>& next,
                         const std::function<Result(std::int64_t, ReadingStream&)>& take)
{
  for (int r = 1; r < this->Ranks.Size(); ++r)
  {
    std::int64_t& wanted = this->Wanted[r];
    while (this->Ranks.HasMessage(r))
    {
      const WorkMessage message = HearFrom(this->Ranks, r);
      if (message.Says == Word::Wants)
      {
        wanted = message.Item;
        continue;
      }
      Say(this->Ranks, r, Word::Send);
      std::vector<char> content = BytesFrom(this->Ranks, r, message.Size);
      if (message.Says == Word::Failed)
      {
        return Result::Error(std::string(content.begin(), content.end()));
      }
      ReadingStream results(std::move(content));
      for (std::int64_t k = 0; k < message.Item; ++k)
      {
        ItemResult one;
        results.Values(one);
        --this->NumberAway;
        ReadingStream result(std::move(one.Content));
        WAFT_RETURN_IF_FAILED(take(one.Item, result));
      }
    }
    const std::vector<std::int64_t> items = wanted > 0 ? next(wanted) : std::vector<std::int64_t>();
    for (std::size_t k = 0; k < items.size(); ++k)
    {
      wanted = 0;
      ++this->NumberAway;
      Say(this->Ranks, r, Word::Item, items[k], items.size() - 1 - k);
    }
  }
  return Result::Ok();
}

void SharedItems::Hear()
{
  const WorkMessage message = HearFrom(this->Ranks, 0);
  if (message.Says == Word::Item)
  {
    this->Items.push_back(message.Item);
    this->MoreFollow = message.Size > 0;
    this->HasAsked = this->MoreFollow;
  }
  else if (message.Says == Word::Send)
  {
    const std::vector<char>& content = this->Results.front().Content;
    this->Ranks.SendReceive(0, content.data(), content.size(), nullptr, 0);
    this->Results.pop_front();
    this->AnnounceNext();
  }
  else
  {
    this->IsEnded = true;
  }
}

void SharedItems::Listen()
{
  while (!this->IsEnded && this->Ranks.HasMessage(0))
  {
    this->Hear();
  }
}

std::vector<std::int64_t> SharedItems::Take(std::int64_t most, bool waits)
{
  this->Listen();
  while (!this->IsEnded && (this->Items.empty() || this->MoreFollow))
  {
    // Between what is announced and its bytes nothing else is said.
    if (this->Results.empty() && !this->HasAsked)
    {
      Say(this->Ranks, 0, Word::Wants, most);
      this->HasAsked = true;
    }
    if (!waits && !this->MoreFollow)
    {
      return {};
    }
    this->Hear();
  }
  return this->IsEnded ? std::vector<std::int64_t>() : std::exchange(this->Items, {});
}

void SharedItems::AnnounceNext()
{
  if (!this->Results.empty())
  {
    const Outcome& next = this->Results.front();
    Say(this->Ranks, 0, next.Says, next.Number, next.Content.size());
  }
}

void SharedItems::Announce(Outcome outcome)
{
  if (!this->IsEnded)
  {
    this->Results.push_back(std::move(outcome));
    if (this->Results.size() == 1)
    {
      this->AnnounceNext();
    }
  }
}

void SharedItems::Give(const std::vector<ItemResult>& results)
{
  MemoryStream all;
  for (const ItemResult& one : results)
  {
    all.Values(one);
  }
  this->Announce({ Word::Has, static_cast<std::int64_t>(results.size()), std::move(all.Content) });
}

void SharedItems::Fail(const std::string& sentence)
{
  this->Announce({ Word::Failed, 0, { sentence.begin(), sentence.end() } });
}

bool SharedItems::IsOver()
{
  this->Listen();
  return this->IsEnded;
}

void SharedItems::AwaitEnd()
{
  while (!this->IsEnded)
  {
    this->Hear();
  }
}

void Serve(Communicator& ranks, const WorkKinds& kinds)
{
  for (WorkMessage job = HearFrom(ranks, 0); job.Says == Word::Job; job = HearFrom(ranks, 0))
  {
    SharedItems items(ranks);
    const Result done = Work(ranks, job, kinds, items);
    if (!done)
    {
      items.Fail(done.Message());
    }
    items.AwaitEnd();
    Say(ranks, 0, Word::Left);
  }
}

void Release(Communicator& ranks)
{
  for (int r = 1; r < ranks.Size(); ++r)
  {
    Say(ranks, r, Word::Free);
  }
}

} // namespace waft
