// SPDX-License-Identifier: BSD-3-Clause
// What the stages that write files have in common.
#pragma once

#include "Base/Result.h"

#include <cstddef>
#include <string>
#include <string_view>

class vtkAlgorithm;

namespace waft
{

/// Does the name end so, with something before it?
bool HasEnding(const std::string& fileName, const std::string& ending);

/// "FileName: expected a name ending in `endings`, found ..."
Result WrongEnding(const std::string& fileName, const std::string& endings);

/// Fails where a file stands at the name that somebody else made: one that has something in it, and
/// not this sign of Waft's among its first bytes.
Result CheckOwn(const std::string& fileName, std::string_view sign, std::size_t firstBytes);

/// Write() of a stage that writes when it executes: executes it, changed or not. `isWritten` is set
/// by its RequestData, and returned. Without a name it reports an error and does nothing.
bool WriteAnew(vtkAlgorithm* writer, const std::string& fileName, const std::string& endings,
               bool& isWritten);

} // namespace waft
