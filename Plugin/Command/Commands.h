// SPDX-License-Identifier: BSD-3-Clause
// The commands of `waft`, and the options of those that are carried out here.
#pragma once

#include "Base/Result.h"
#include "Bridge/Run/FlyScene.h"
#include "Database/DatabaseBuild.h"
#include "Messages.h"

#include <string>
#include <vector>

namespace waft::command
{

struct CommandLine
{
  std::string Name;        // synthesize, check or database
  FlightRequest Flight;    // of the first two
  std::string QualityName; // empty: left open
  bool IsWatched = false;
  bool IsJson = false;    // the answer is a JSON document
  bool TellsJson = false; // progress
  int Threads = 0;        // 0: as many as there are cores
  double TimeLimit = 0.0;
  std::string Database; // the file that is made
  DatabaseOptions Made;
  bool Resumes = false;
  Loudness Shown = Loudness::Normal;
  std::string Log;
};

/// status: of a command line that asks for help, or is wrong, both of which were said; else -1.
CommandLine Parse(const std::vector<std::string>& arguments, int& status);

/// Fills in what the command line leaves open. Fails where settings of the user's are wrong, and
/// where there are none of what is needed.
Result Settle(CommandLine& line);

/// All commands as JSON: `commands` ({name: sentence}), `exit`; `own`: {name: `epilog`, `options`},
/// each option with its `flags` (none: it is given by its place), `value` (what stands for it, or
/// null of a flag), `help`, `choices`, `field` (the name that programs have for it).
std::string DescribeCommands();

} // namespace waft::command
