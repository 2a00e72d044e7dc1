// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Files/FileWriting.h"

#include <vtkAlgorithm.h>

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
