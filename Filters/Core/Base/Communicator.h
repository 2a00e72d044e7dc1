// SPDX-License-Identifier: BSD-3-Clause
// Ranks, injected by the caller: one here, vtkMultiProcessController in the wrappers. All ranks run
// the same kernel on the same input and call the same functions here in the same order.
#pragma once

#include "Base/Monitor.h"
#include "Base/StateArchive.h"

#include <cstddef>
#include <string>
#include <vector>

namespace waft
{

/// An implementation gives SendReceive alone. Nothing here fails: where ranks cannot be reached the
/// implementation ends the program, as MPI does.
class Communicator
{
public:
  using Bytes = std::vector<char>;

  virtual ~Communicator() = default;
  virtual int Rank() const = 0; // 0..Size() - 1; rank 0 decides
  virtual int Size() const = 0;
  bool IsFirst() const { return this->Rank() == 0; }

  /// Swaps bytes with another rank, which calls this at the same time with the sizes swapped. A
  /// size of zero moves nothing in its direction.
  virtual void SendReceive(int other, const void* sent, std::size_t sentSize, void* received,
                           std::size_t receivedSize) = 0;

  /// sent[r] goes to rank r and comes from there into received[r], whose sizes are known
  /// beforehand.
  void Exchange(const std::vector<Bytes>& sent, std::vector<Bytes>& received);
  /// The bytes of one rank, on all of them.
  void Broadcast(void* bytes, std::size_t size, int from = 0);
  /// What rank 0 says, on all of them.
  bool Decide(bool answer);
  /// The largest of all ranks' values.
  double Largest(double value);
};

/// One rank.
class SerialCommunicator : public Communicator
{
public:
  int Rank() const override { return 0; }
  int Size() const override { return 1; }
  void SendReceive(int, const void*, std::size_t, void*, std::size_t) override {}
};

/// Asks rank 0's monitor for all. Tick is then to be called by all ranks at once.
class RankMonitor : public Monitor
{
public:
  RankMonitor(Monitor& own, Communicator& ranks) : Own(own), Ranks(ranks) {}
  bool Tick(double fraction, const std::string& text) override
  {
    return this->Ranks.Decide(this->Own.Tick(fraction, text));
  }

private:
  Monitor& Own;
  Communicator& Ranks;
};

/// What rank 0 writes here the others read: a function that writes and reads a structure makes it
/// the same on all.
class BroadcastStream : public StateArchive
{
public:
  explicit BroadcastStream(Communicator& ranks) : Ranks(ranks) {}
  bool IsReading() const override { return !this->Ranks.IsFirst(); }

protected:
  bool Bytes(void* bytes, std::size_t size) override;

private:
  Communicator& Ranks;
};

/// One file for all ranks: rank 0 writes it, and what rank 0 reads goes to all.
class RankFileStream : public StateArchive
{
public:
  /// file: of rank 0; null on the others.
  RankFileStream(Communicator& ranks, StateArchive* file, bool isReading) :
    Ranks(ranks), File(file), Reads(isReading)
  {
  }
  bool IsReading() const override { return this->Reads; }
  std::uint64_t Left() const override;

protected:
  bool Bytes(void* bytes, std::size_t size) override;

private:
  Communicator& Ranks;
  StateArchive* File;
  bool Reads;
};

} // namespace waft
