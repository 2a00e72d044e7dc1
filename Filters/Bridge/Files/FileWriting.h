// SPDX-License-Identifier: BSD-3-Clause
// What the stages that write files have in common.
#pragma once

#include "Base/Result.h"

#include <string>

class vtkAlgorithm;

namespace waft
{

/// Does the name end so, with something before it?
bool HasEnding(const std::string& fileName, const std::string& ending);

/// "FileName: expected a name ending in `endings`, found ..."
Result WrongEnding(const std::string& fileName, const std::string& endings);

/// Write() of a stage that writes when it executes: executes it, changed or not. `isWritten` is set
/// by its RequestData, and returned. Without a name it reports an error and does nothing.
bool WriteAnew(vtkAlgorithm* writer, const std::string& fileName, const std::string& endings,
               bool& isWritten);

} // namespace waft
