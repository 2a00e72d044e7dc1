// SPDX-License-Identifier: BSD-3-Clause
// VTK's XML files, looked at whole before its readers see them, which trust their counts.
#pragma once

#include "Base/Result.h"

#include <functional>
#include <string>
#include <vector>

namespace waft
{

/// Unpacks a block by a compressor of this name; false unless it fills `bytes`, no more and no
/// less.
using BlockUnpacker =
  std::function<bool(const std::string& compressor, const std::string& packed, std::string& bytes)>;

/// Looks at the elements of a .vtp, .vti, .vtt or .vtm: whole and closed, counts and extents that
/// the file's size allows, arrays with as many values as these say (as far as their headers tell)
/// and no more texts, pieces within their image, in a .vtm indices of blocks, their nesting, and
/// the files of blocks, which are surfaces and tables, each named once. Of all files together the
/// values take at most 512 MiB in memory, or 8 times the size of the files. What the arrays hold
/// the readers say. types: of VTKFile, those that may be; unpack: what texts
/// are in is looked at. Fails, naming the byte and the element.
Result CheckDataFile(const std::string& path, const std::vector<std::string>& types,
                     const BlockUnpacker& unpack);

} // namespace waft
