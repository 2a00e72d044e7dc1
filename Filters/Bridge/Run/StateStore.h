// SPDX-License-Identifier: BSD-3-Clause
// What finished runs leave for later ones beside their results.
#pragma once

#include "Bridge/Run/FolderBelow.h"

#include <cstdint>
#include <functional>
#include <string>

namespace waft
{

/// The states of the air of finished runs, by the keys of the runs, in the folder that the
/// environment names as WAFT_CACHE, else ~/.cache/waft. Nothing needs it to be right: without a
/// home, room or rights all works as without it, and what is gone is made again. Several processes
/// may use it at once; files in it of other names are left alone.
class StateStore
{
public:
  /// most: bytes, beyond which the oldest go.
  explicit StateStore(std::uint64_t most = 5000000000);

  /// The path of the state of a run; empty where there is none.
  std::string Found(const std::string& key) const;
  /// Has a state written for a run whose key has none: write(path) writes it whole or not at all.
  void Make(const std::string& key, const std::function<Result(const std::string&)>& write) const;
  /// Takes a file of a folder over as the state of a run.
  void Keep(const std::string& key, const FolderBelow& folder, const std::string& name) const;

private:
  void DropOldest(const std::string& latest) const;

  FolderBelow Kept;
  std::uint64_t Most;
};

} // namespace waft
