// SPDX-License-Identifier: BSD-3-Clause
// What a user has said once for all of `waft synthesize`: threads, quality and output, by the
// variables WAFT_THREADS and so on, or by the file waft.toml in the user's folder of settings. With
// WAFT_DEFAULTS=off nothing of this counts, as in takes and tests.
#pragma once

#include "Base/Result.h"

#include <functional>
#include <string>
#include <vector>

namespace waft::command
{

/// An option that a user may have settled.
struct Setting
{
  std::string Name;
  bool IsWhole = false;
  bool IsOpen = true; // the command line leaves it open
  /// What was expected, where a text is none of its values; else an empty text.
  std::function<std::string(const std::string&)> Check;
  std::function<std::string(const std::string&)> Take; // gives what it means
};

/// Fills in those that are open, the variables first. defaults: JSON, {name: {value, from}} of what
/// was filled in. Fails with file, line and key, or the variable.
Result ApplySettings(const std::vector<Setting>& settings, std::string& defaults);

} // namespace waft::command
