// SPDX-License-Identifier: BSD-3-Clause
// Makes a small motion database, of coarse air, in some seconds.
#include "Database/DatabaseBuild.h"
#include "Trajectory/DatabaseFile.h"

#include <iostream>

using namespace waft;

int main(int, char** words) // FILE
{
  DatabaseOptions options;
  options.NumberOfSimulations = 2;
  options.NumberOfFrames = 120;
  options.Resolution = 24;
  SilentMonitor monitor;
  MotionDatabase database;
  std::vector<CoveragePoint> coverage;
  Result result = BuildDatabase(options, SerialFor(), monitor, database, coverage);
  result = result ? WriteDatabase(words[1], database) : result;
  std::cerr << result.Message();
  return result ? 0 : 1;
}
