// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/FileWriting.h"

#include <vtkAlgorithm.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace waft
{

bool HasEnding(const std::string& fileName, const std::string& ending)
{
  return fileName.size() > ending.size() &&
         fileName.compare(fileName.size() - ending.size(), ending.size(), ending) == 0;
}

Result WrongEnding(const std::string& fileName, const std::string& endings)
{
  return Result::Error("FileName: expected a name ending in " + endings + ", found " +
                       (fileName.empty() ? "none" : "\"" + fileName + "\""));
}

Result CheckOwn(const std::string& fileName, std::string_view sign, std::size_t firstBytes)
{
  std::error_code error;
  if (!std::filesystem::is_regular_file(fileName, error))
  {
    return Result::Ok(); // the system says what keeps it from being written
  }
  std::ifstream stream(fileName, std::ios::binary);
  std::string found(std::min<std::uintmax_t>(firstBytes, std::filesystem::file_size(fileName)),
                    ' ');
  stream.read(found.data(), static_cast<std::streamsize>(found.size()));
  return found.empty() || found.find(sign) != std::string::npos
           ? Result::Ok()
           : Result::Error("FileName: " + fileName +
                           ": nothing was written: expected a new name or a file that Waft wrote, "
                           "found another, which is left alone");
}

bool WriteAnew(vtkAlgorithm* writer, const std::string& fileName, const std::string& endings,
               bool& isWritten)
{
  if (fileName.empty())
  {
    vtkErrorWithObjectMacro(writer, << WrongEnding(fileName, endings).Message());
    return false;
  }
  isWritten = false;
  writer->Modified();
  writer->Update();
  return isWritten;
}

} // namespace waft
