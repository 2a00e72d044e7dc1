// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/EmbeddedDatabase.h"

#include "Bridge/Data/DatabaseConversion.h"
#include "Bridge/Files/DataFiles.h"
#include "Bridge/Files/InstalledData.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>

#include <string>

namespace waft
{

Result ReadEmbeddedDatabase(MotionDatabase& database)
{
  std::string path;
  WAFT_RETURN_IF_FAILED(FindDataFile("Database/embedded.vtm", path));
  return ReadDatabaseFile(path, database);
}

Result ReadDatabaseFile(const std::string& path, MotionDatabase& database)
{
  const vtkNew<vtkMultiBlockDataSet> data;
  Result result = ReadBlocksFile(path, data);
  result = result ? DatabaseFromMultiBlock(data, database) : result;
  return result ? result : Result::Error(path + ": " + result.Message());
}

} // namespace waft
