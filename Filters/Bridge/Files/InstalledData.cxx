// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/InstalledData.h"

#include <dlfcn.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace fs = std::filesystem;

namespace waft
{
namespace
{

fs::path LibraryFile()
{
  Dl_info about{};
  const auto* here = reinterpret_cast<const void*>(&FindDataFile);
  std::error_code failure;
  return dladdr(here, &about) != 0 && about.dli_fname != nullptr
           ? fs::weakly_canonical(about.dli_fname, failure)
           : fs::path();
}

} // namespace

Result FindDataFile(const std::string& name, std::string& path)
{
  std::error_code failure;
  const char* given = std::getenv("WAFT_DATA");
  if (given != nullptr && *given != '\0')
  {
    const fs::path file = fs::path(given) / name;
    path = file.string();
    return fs::is_regular_file(file, failure)
             ? Result::Ok()
             : Result::Error(path + ": no such file in the folder that WAFT_DATA names");
  }
  const fs::path library = LibraryFile();
  for (fs::path folder = library.parent_path(); folder.has_relative_path();
       folder = folder.parent_path())
  {
    const fs::path file = folder / "share/waft/Data" / name;
    if (fs::is_regular_file(file, failure))
    {
      path = file.string();
      return Result::Ok();
    }
  }
  return Result::Error("share/waft/Data/" + name + ": expected above " + library.string() +
                       ", found in no folder; WAFT_DATA can name another");
}

std::string NamedFile(const std::string& name)
{
  std::error_code failure;
  std::string path;
  const fs::path inData = fs::path(name).lexically_relative("Data");
  const bool isOurs = !inData.empty() && *inData.begin() != ".." && !fs::exists(name, failure);
  return isOurs && FindDataFile(inData.string(), path) ? path : name;
}

} // namespace waft
