// SPDX-License-Identifier: BSD-3-Clause
// A loop over items by the threads of rank 0 and by other ranks: who is free takes the next item.
#pragma once

#include "Base/Parallel.h"
#include "Base/SharedWork.h"

#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace waft
{

/// What rank 0 does with the items, each of which has a slot of its own for what comes of it.
struct SharedLoop
{
  std::string Kind;                               // that the others know
  std::vector<std::size_t> Items;                 // begun from the first to the last
  std::function<void(StateArchive& inputs)> Tell; // all that the others need to know
  /// What follows it, of the caller's thread while work has begun here; may be empty. The others
  /// receive it before they ask for items.
  std::function<void(Communicator& ranks)> Send;
  std::function<void(std::size_t item)> Work; // of any thread
  /// What came of an item elsewhere, of the caller's thread.
  std::function<void(std::size_t item, ReadingStream& result)> Take;
  /// Of the caller's thread every now and then, where that does not work itself; may be empty.
  std::function<void()> Watch;
  /// The caller's thread watches even where there are no others. Else it may be one of those that
  /// work.
  bool IsWatched = false;
};

/// Until all items are done, or `stop` is set. ranks: null: there are no others.
Result RunShared(const SharedLoop& loop, Communicator* ranks, const ParallelFor& parallel,
                 std::atomic<bool>& stop);

/// The items that rank 0 hands to this rank, as many at once as `most`. work writes what comes of
/// one, on any thread. stop is set when rank 0 needs no more.
void ServeLoop(SharedItems& items, int most, const ParallelFor& parallel,
               const std::function<void(std::size_t item, StateArchive& result)>& work,
               std::atomic<bool>& stop);

} // namespace waft
