// SPDX-License-Identifier: BSD-3-Clause
// VTK's XML files, looked at whole before its readers see them, which trust their counts.
#pragma once

#include "Base/Result.h"

#include <string>
#include <vector>

namespace waft
{

/// Looks at the elements of a .vtp, .vti, .vtt or .vtm: whole and closed, counts and extents that
/// the file's size allows, arrays with as many values as these say (as far as their headers tell),
/// in a .vtm indices of blocks, their nesting, and the files of blocks, which are surfaces and
/// tables, each named once. Of all files together the values take at most 512 MiB in memory, or 8
/// times the size of the files. What the arrays hold the readers say. types: of VTKFile, those that
/// may be. Fails, naming the byte and the element.
Result CheckDataFile(const std::string& path, const std::vector<std::string>& types);

} // namespace waft
