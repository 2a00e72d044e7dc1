// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Model/FramePartition.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace waft
{

FramePartition::FramePartition(std::size_t frames) :
  Count(frames), Owned{ 0, frames }, Kept{ 0, frames }
{
}

FramePartition::FramePartition(std::size_t frames, std::size_t halo, Communicator& ranks) :
  FramePartition(frames)
{
  if (ranks.Size() > 1)
  {
    this->Ranks = &ranks;
    this->Halo = halo;
    this->Owned = this->OwnOf(ranks.Rank());
    this->Kept = this->HeldOf(ranks.Rank());
  }
}

FramePartition FramePartition::HoldingAll() const
{
  FramePartition partition = *this;
  partition.Halo = this->Count;
  partition.Kept = { 0, this->Count };
  return partition;
}

FrameRange FramePartition::OwnOf(int rank) const
{
  const auto ranks = static_cast<std::size_t>(this->Ranks->Size());
  const auto r = static_cast<std::size_t>(rank);
  return { this->Count * r / ranks, this->Count * (r + 1) / ranks };
}

FrameRange FramePartition::HeldOf(int rank) const
{
  const FrameRange own = this->OwnOf(rank);
  return { own.Begin - std::min(own.Begin, this->Halo),
           std::min(this->Count, own.End + this->Halo) };
}

int FramePartition::OwnerOf(std::size_t j) const
{
  int rank = 0;
  while (!this->IsAlone() && !this->OwnOf(rank).Contains(j))
  {
    ++rank;
  }
  return rank;
}

std::size_t FramePartition::MostOwned() const
{
  if (this->IsAlone())
  {
    return this->Count;
  }
  const auto ranks = static_cast<std::size_t>(this->Ranks->Size());
  return (this->Count + ranks - 1) / ranks;
}

void FramePartition::Move(const Part& part, const RangeOf& has, const RangeOf& wants) const
{
  if (this->IsAlone())
  {
    return;
  }
  const int me = this->Ranks->Rank();
  const auto block = [&](std::size_t j)
  { return static_cast<char*>(part.Data) + (j - part.FirstFrame) * part.BlockSize + part.Offset; };
  const auto shared = [&](int from, int to)
  {
    const FrameRange a = has(from);
    const FrameRange b = wants(to);
    const std::size_t begin = std::max(a.Begin, b.Begin);
    return FrameRange{ begin, std::max(begin, std::min(a.End, b.End)) };
  };
  std::vector<Communicator::Bytes> sent(this->Ranks->Size()), received(this->Ranks->Size());
  for (int r = 0; r < this->Ranks->Size(); ++r)
  {
    if (r == me)
    {
      continue;
    }
    const FrameRange out = shared(me, r);
    sent[r].resize(out.Size() * part.Size);
    for (std::size_t j = out.Begin; j < out.End; ++j)
    {
      std::memcpy(sent[r].data() + (j - out.Begin) * part.Size, block(j), part.Size);
    }
    received[r].resize(shared(r, me).Size() * part.Size);
  }
  this->Ranks->Exchange(sent, received);
  for (int r = 0; r < this->Ranks->Size(); ++r)
  {
    const FrameRange in = r == me ? FrameRange() : shared(r, me);
    for (std::size_t j = in.Begin; j < in.End; ++j)
    {
      std::memcpy(block(j), received[r].data() + (j - in.Begin) * part.Size, part.Size);
    }
  }
}

void FramePartition::FillHalo(std::vector<float>& held, std::size_t blockSize) const
{
  const std::size_t size = blockSize * sizeof(float);
  this->Move(
    { held.data(), this->Kept.Begin, size, 0, size }, [this](int r) { return this->OwnOf(r); },
    [this](int r) { return this->HeldOf(r); });
}

std::vector<float> FramePartition::Take(std::vector<float> all, std::size_t blockSize) const
{
  if (this->Kept.Size() == this->Count)
  {
    return all;
  }
  const auto at = [&](std::size_t j)
  { return all.begin() + static_cast<std::ptrdiff_t>(j * blockSize); };
  return { at(this->Kept.Begin), at(this->Kept.End) };
}

std::vector<float> FramePartition::Whole(std::vector<float> held, std::size_t blockSize) const
{
  if (this->IsAlone())
  {
    return held;
  }
  std::vector<float> all(this->Count * blockSize, 0.0f);
  const auto own = static_cast<std::ptrdiff_t>(this->Slot(this->Owned.Begin) * blockSize);
  std::copy_n(held.begin() + own, this->Owned.Size() * blockSize,
              all.begin() + static_cast<std::ptrdiff_t>(this->Owned.Begin * blockSize));
  held = std::vector<float>();
  this->Gather(all, blockSize);
  return all;
}

void FramePartition::GatherPoints(const std::vector<std::size_t>& frames,
                                  std::vector<float>& points) const
{
  if (this->IsAlone() || frames.empty())
  {
    return;
  }
  constexpr std::size_t Size = 3 * sizeof(float);
  const int ranks = this->Ranks->Size();
  std::vector<int> owners(frames.size());
  std::vector<std::size_t> counts(ranks, 0);
  for (std::size_t k = 0; k < frames.size(); ++k)
  {
    owners[k] = this->OwnerOf(frames[k]);
    ++counts[owners[k]];
  }
  Communicator::Bytes own;
  for (std::size_t k = 0; k < frames.size(); ++k)
  {
    if (owners[k] == this->Ranks->Rank())
    {
      const char* first = reinterpret_cast<const char*>(points.data() + 3 * k);
      own.insert(own.end(), first, first + Size);
    }
  }
  const std::vector<Communicator::Bytes> sent(ranks, own);
  std::vector<Communicator::Bytes> received(ranks);
  for (int r = 0; r < ranks; ++r)
  {
    received[r].resize(counts[r] * Size);
  }
  this->Ranks->Exchange(sent, received);
  std::vector<std::size_t> taken(ranks, 0);
  for (std::size_t k = 0; k < frames.size(); ++k)
  {
    const int r = owners[k];
    std::memcpy(points.data() + 3 * k, received[r].data() + Size * taken[r]++, Size);
  }
}

void FramePartition::BringToFirst(std::size_t j, Communicator::Bytes& bytes) const
{
  const int owner = this->OwnerOf(j);
  if (this->IsAlone() || owner == 0)
  {
    return;
  }
  std::uint64_t size = bytes.size();
  if (owner == this->Ranks->Rank())
  {
    this->Ranks->SendReceive(0, &size, sizeof(size), nullptr, 0);
    this->Ranks->SendReceive(0, bytes.data(), bytes.size(), nullptr, 0);
    bytes.clear();
  }
  else if (this->Ranks->IsFirst())
  {
    this->Ranks->SendReceive(owner, nullptr, 0, &size, sizeof(size));
    bytes.resize(size);
    this->Ranks->SendReceive(owner, nullptr, 0, bytes.data(), bytes.size());
  }
}

void FramePartition::Serialise(StateArchive& stream, std::vector<float>& held,
                               std::size_t blockSize) const
{
  if (this->IsAlone())
  {
    stream.List(held);
    return;
  }
  std::uint64_t count = this->Count * blockSize;
  stream.Value(count);
  if (stream.IsReading())
  {
    held.assign(this->Kept.Size() * blockSize, 0.0f);
    if (count != this->Count * blockSize)
    {
      return; // the stream does not end where it should
    }
  }
  const std::size_t size = blockSize * sizeof(float);
  std::vector<float> block(blockSize);
  for (std::size_t j = 0; j < this->Count; ++j)
  {
    const auto offset = static_cast<std::ptrdiff_t>(this->Slot(j) * blockSize);
    if (!stream.IsReading())
    {
      Communicator::Bytes bytes;
      if (this->Owned.Contains(j))
      {
        const char* first = reinterpret_cast<const char*>(held.data() + offset);
        bytes.assign(first, first + size);
      }
      this->BringToFirst(j, bytes);
      stream.Raw(bytes.data(), bytes.size());
      continue;
    }
    stream.Raw(block.data(), size);
    if (this->Kept.Contains(j))
    {
      std::copy_n(block.begin(), blockSize, held.begin() + offset);
    }
  }
}

} // namespace waft
