// SPDX-License-Identifier: BSD-3-Clause
// The file that a run can be taken up from.
#pragma once

#include "Store/StateFile.h"

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
  std::uint64_t Key; // of all that the run follows from
  const char* Done;  // what is done from the start without it: "planned"
};

/// Says in warnings why it cannot be written, or is not gone on from.
class CheckpointFile
{
public:
  CheckpointFile(Checkpoint what, std::vector<std::string>& warnings);

  bool IsNamed() const { return !this->What.Path.empty(); }
  /// Never again once writing failed.
  bool IsDue() const { return this->IsNamed() && !this->HasFailed; }
  using Content = std::function<void(StateArchive& stream)>;
  void Write(const Content& content);
  /// False when there is none, or when it is not of this run; what content read is to be thrown
  /// away then.
  bool Read(const StateContent& content);
  void Remove() const;

private:
  Checkpoint What;
  std::vector<std::string>& Warnings;
  bool HasFailed = false;
};

} // namespace waft
