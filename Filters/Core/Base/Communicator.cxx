// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Communicator.h"

#include <algorithm>
#include <string>

namespace waft
{
namespace
{

/// Rank 0's.
Result Told(Communicator& ranks, const Result& own)
{
  bool isGood(own);
  bool isStopped = own.IsStopped();
  std::string message = own.Message();
  BroadcastStream stream(ranks);
  stream.Values(isGood, isStopped);
  stream.Text(message);
  return ranks.IsFirst() ? own
         : isStopped     ? Result::Stopped()
         : isGood        ? Result::Ok()
                         : Result::Error(message);
}

} // namespace

void Communicator::Broadcast(void* bytes, std::size_t size, int from)
{
  const int ranks = this->Size();
  const int slot = (this->Rank() - from + ranks) % ranks;
  for (int reached = 1; reached < ranks; reached *= 2)
  {
    if (slot < reached && slot + reached < ranks)
    {
      this->SendReceive((slot + reached + from) % ranks, bytes, size, nullptr, 0);
    }
    else if (slot >= reached && slot < 2 * reached)
    {
      this->SendReceive((slot - reached + from) % ranks, nullptr, 0, bytes, size);
    }
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

bool BroadcastStream::Bytes(void* bytes, std::size_t size)
{
  this->Ranks.Broadcast(bytes, size);
  return true;
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
    (void)Told(ranks, Result::Error("the first process has failed"));
    throw;
  }
  return Told(ranks, own);
}

} // namespace waft
