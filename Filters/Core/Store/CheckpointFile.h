// SPDX-License-Identifier: BSD-3-Clause
// The file that a run can be taken up from.
#pragma once

#include "Store/StateFile.h"
#include "Store/WritingSchedule.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace waft
{

struct Checkpoint
{
  std::string Path; // empty: none is kept
  StateKind Kind;
  std::uint64_t Key;     // of all that the run follows from
  double Interval = 0.0; // s, between two writings at the least (WritingSchedule)
  const char* Done;      // what is done from the start without it: "solved"
};

/// Says in warnings why it cannot be written, or is not gone on from.
class CheckpointFile
{
public:
  CheckpointFile(Checkpoint what, std::vector<std::string>& warnings);

  bool IsNamed() const { return !this->What.Path.empty(); }
  /// The schedule says so, or somebody asks for it now; never again once writing failed.
  bool IsDue(bool now) const;
  using Content = std::function<void(StateArchive& stream)>;
  /// now: however long it takes. Otherwise it is given up when it takes too long; the last file
  /// stays then.
  void Write(const Content& content, bool now);
  /// False when there is none, or when it is not of this run; what content read is to be thrown
  /// away then.
  bool Read(const StateContent& content);
  void Remove() const;

private:
  double Elapsed() const;

  Checkpoint What;
  std::vector<std::string>& Warnings;
  std::chrono::steady_clock::time_point Begin;
  WritingSchedule Schedule;
  bool HasFailed = false;
};

} // namespace waft
