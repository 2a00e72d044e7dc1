// SPDX-License-Identifier: BSD-3-Clause
// The file that a run can be taken up from.
#pragma once

#include "Base/WritingSchedule.h"
#include "Spacetime/Model/SpacetimeOptions.h"
#include "Spacetime/Scene/SpacetimeInput.h"
#include "Store/StateFile.h"

#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace waft
{

class CheckpointFile
{
public:
  CheckpointFile(const SpacetimeInput& input, const SpacetimeOptions& options,
                 std::vector<std::string>& warnings);

  /// A file is named.
  bool IsNamed() const { return !this->Path.empty(); }
  /// The schedule says so, or somebody asks for it now; never again once writing failed.
  bool IsDue(bool now) const;
  using Content = std::function<void(StateArchive& stream)>;
  /// now: however long it takes. Otherwise it is given up when it takes too long; the last file
  /// stays then.
  void Write(const Content& content, bool now);
  /// False when there is none, or when it is not of this run: then a warning says why, and what
  /// content read is to be thrown away.
  bool Read(const StateContent& content);
  void Remove() const;

private:
  double Elapsed() const;

  const std::string Path;
  std::uint64_t Key; // of the run
  std::vector<std::string>& Warnings;
  std::chrono::steady_clock::time_point Begin;
  WritingSchedule Schedule;
  bool HasFailed = false;
};

} // namespace waft
