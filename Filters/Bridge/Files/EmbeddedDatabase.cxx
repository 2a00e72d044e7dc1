// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/EmbeddedDatabase.h"

#include "Bridge/Data/DatabaseConversion.h"
#include "Bridge/Files/DataFiles.h"
#include "Bridge/Files/InstalledData.h"
#include "Trajectory/DatabaseFile.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

namespace waft
{

Result ReadEmbeddedDatabase(MotionDatabase& database)
{
  std::string path;
  WAFT_RETURN_IF_FAILED(FindDataFile("Database/embedded.vtm", path));
  // What the build has made of the same file for programs without VTK is read in a tenth of the
  // time; it is of this very build, or refused.
  const std::filesystem::path data = std::filesystem::path(path).parent_path().parent_path();
  const std::filesystem::path made = data.parent_path() / "Database/embedded.motions";
  std::error_code failure;
  const bool isMade = std::getenv("WAFT_DATA") == nullptr &&
                      std::filesystem::is_regular_file(made, failure) &&
                      ReadDatabase(made.string(), database);
  return isMade ? Result::Ok() : ReadDatabaseFile(path, database);
}

Result ReadDatabaseFile(const std::string& path, MotionDatabase& database)
{
  const vtkNew<vtkMultiBlockDataSet> data;
  Result result = ReadBlocksFile(path, data);
  result = result ? DatabaseFromMultiBlock(data, database) : result;
  return result ? result : Result::Error(path + ": " + result.Message());
}

} // namespace waft
