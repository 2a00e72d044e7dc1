// SPDX-License-Identifier: BSD-3-Clause
// Ranks, injected by the caller: those of a vtkMultiProcessController in the wrappers.
#pragma once

#include "Base/Monitor.h"
#include "Base/Result.h"
#include "Base/StateArchive.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace waft
{

/// An implementation gives SendReceive and HasMessage alone. Nothing here fails: where ranks cannot
/// be reached the implementation ends the program, as MPI does.
class Communicator
{
public:
  virtual ~Communicator() = default;
  virtual int Rank() const = 0; // 0..Size() - 1; rank 0 decides
  virtual int Size() const = 0;
  bool IsFirst() const { return this->Rank() == 0; }

  /// Swaps bytes with another rank, which calls this at the same time with the sizes swapped. A
  /// size of zero moves nothing in its direction.
  virtual void SendReceive(int other, const void* sent, std::size_t sentSize, void* received,
                           std::size_t receivedSize) = 0;
  /// Whether something that another rank sent can be received without waiting.
  virtual bool HasMessage(int from) = 0;

  /// The bytes of one rank, on all of them: all call it, as Largest.
  void Broadcast(void* bytes, std::size_t size, int from = 0)
  {
    this->Broadcast(bytes, bytes, size, from);
  }
  /// The same: `from` sends, the others receive.
  void Broadcast(const void* sent, void* received, std::size_t size, int from);
  /// Each rank's part of an array of items of so many bytes, on all of them. begins: the first item
  /// of each rank, and the end.
  void Gather(void* items, std::size_t size, const std::vector<std::size_t>& begins);
  /// The largest of all ranks' values.
  double Largest(double value);
};

/// The first item of each rank, and the end, where all have as many or one more.
inline std::vector<std::size_t> BeginsOfRanks(std::size_t items, int ranks)
{
  const auto size = static_cast<std::size_t>(ranks);
  std::vector<std::size_t> begins;
  for (std::size_t r = 0; r <= size; ++r)
  {
    begins.push_back(items * r / size);
  }
  return begins;
}

/// No others.
class SingleRank : public Communicator
{
public:
  int Rank() const override { return 0; }
  int Size() const override { return 1; }
  void SendReceive(int, const void*, std::size_t, void*, std::size_t) override {}
  bool HasMessage(int) override { return false; }
};

/// What rank 0 writes here the others read: a function that writes and reads a structure makes it
/// the same on all.
class BroadcastStream : public StateArchive
{
public:
  explicit BroadcastStream(Communicator& ranks) : Ranks(ranks) {}
  bool IsReading() const override { return !this->Ranks.IsFirst(); }

protected:
  bool Put(const void* bytes, std::size_t size) override
  {
    this->Ranks.Broadcast(bytes, nullptr, size, 0);
    return true;
  }
  bool Get(void* bytes, std::size_t size) override
  {
    this->Ranks.Broadcast(nullptr, bytes, size, 0);
    return true;
  }

private:
  Communicator& Ranks;
};

/// Whether work goes on that all ranks do: the first one's monitor is asked. All call it.
bool GoesOn(Communicator& ranks, Monitor& monitor, double done);

/// What rank 0 alone works out: its result, on all ranks. They wait for it meanwhile, and where
/// work is left by an exception they get an error.
Result ResultOfFirst(Communicator& ranks, const std::function<Result()>& work);

} // namespace waft
