// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Communicator.h"

#include <algorithm>

namespace waft
{

void Communicator::Exchange(const std::vector<Bytes>& sent, std::vector<Bytes>& received)
{
  const int rank = this->Rank();
  const int size = this->Size();
  received[rank] = sent[rank];
  // In each round all ranks are paired off, so that none waits for one that waits for a third.
  int rounds = 1;
  while (rounds < size)
  {
    rounds *= 2;
  }
  for (int round = 1; round < rounds; ++round)
  {
    const int other = rank ^ round;
    if (other < size)
    {
      this->SendReceive(other, sent[other].data(), sent[other].size(), received[other].data(),
                        received[other].size());
    }
  }
}

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

bool Communicator::Decide(bool answer)
{
  char byte = answer ? 1 : 0;
  this->Broadcast(&byte, 1);
  return byte != 0;
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

std::uint64_t RankFileStream::Left() const
{
  std::uint64_t left = this->File != nullptr ? this->File->Left() : 0;
  this->Ranks.Broadcast(&left, sizeof(left));
  return left;
}

bool RankFileStream::Bytes(void* bytes, std::size_t size)
{
  bool isGood = true;
  if (this->File != nullptr)
  {
    this->File->Raw(bytes, size);
    isGood = this->File->IsGood();
  }
  if (!this->Reads)
  {
    return isGood; // Commit tells of failures
  }
  isGood = this->Ranks.Decide(isGood);
  if (isGood)
  {
    this->Ranks.Broadcast(bytes, size);
  }
  return isGood;
}

} // namespace waft
