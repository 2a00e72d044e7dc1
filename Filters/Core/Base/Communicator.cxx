// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Communicator.h"

#include <algorithm>
#include <string>

namespace waft
{
namespace
{

/// Rank 0's.
Result FromFirst(Communicator& ranks, const Result& own)
{
  bool isGood(own);
  bool isStopped = own.IsStopped();
  std::string message = own.Message();
  BroadcastStream stream(ranks);
  stream.Values(isGood, isStopped, message);
  return ranks.IsFirst() ? own
         : isStopped     ? Result::Stopped()
         : isGood        ? Result::Ok()
                         : Result::Error(message);
}

} // namespace

void Communicator::Broadcast(const void* sent, void* received, std::size_t size, int from)
{
  const int ranks = this->Size();
  const int slot = (this->Rank() - from + ranks) % ranks;
  const void* passedOn = slot == 0 ? sent : received;
  for (int reached = 1; reached < ranks; reached *= 2)
  {
    if (slot < reached && slot + reached < ranks)
    {
      this->SendReceive((slot + reached + from) % ranks, passedOn, size, nullptr, 0);
    }
    else if (slot >= reached && slot < 2 * reached)
    {
      this->SendReceive((slot - reached + from) % ranks, nullptr, 0, received, size);
    }
  }
}

void Communicator::Gather(void* items, std::size_t size, const std::vector<std::size_t>& begins)
{
  for (int r = 0; r < this->Size(); ++r)
  {
    const auto rank = static_cast<std::size_t>(r);
    char* part = static_cast<char*>(items) + size * begins[rank];
    this->Broadcast(part, size * (begins[rank + 1] - begins[rank]), r);
  }
}

double Communicator::Largest(double value)
{
  for (int r = 0; r < this->Size(); ++r)
  {
    double other = value;
    this->Broadcast(&other, sizeof(other), r);
    value = std::max(value, other);
  }
  return value;
}

bool GoesOn(Communicator& ranks, Monitor& monitor, double done)
{
  char goesOn = ranks.IsFirst() && monitor.Tick(done, "") ? 1 : 0;
  ranks.Broadcast(&goesOn, sizeof(goesOn));
  return goesOn != 0;
}

Result ResultOfFirst(Communicator& ranks, const std::function<Result()>& work)
{
  Result own = Result::Ok();
  try
  {
    own = ranks.IsFirst() ? work() : own;
  }
  catch (...)
  {
    (void)FromFirst(ranks, Result::Error("the first process has failed"));
    throw;
  }
  return FromFirst(ranks, own);
}

} // namespace waft
