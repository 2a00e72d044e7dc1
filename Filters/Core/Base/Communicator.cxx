// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Communicator.h"

#include <algorithm>

namespace waft
{

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

bool PeerStream::Bytes(void* bytes, std::size_t size)
{
  this->Ranks.SendReceive(this->Other, bytes, this->Reads ? 0 : size, bytes,
                          this->Reads ? size : 0);
  return true;
}

} // namespace waft
