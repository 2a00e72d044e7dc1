// SPDX-License-Identifier: BSD-3-Clause
// The files that come with Waft.
#pragma once

#include "Base/Result.h"

#include <string>

namespace waft
{

/// The path of a file that comes with Waft, such as Database/embedded.vtm: in the folder that the
/// environment names as WAFT_DATA, else in share/waft/Data of the nearest folder above this
/// library.
Result FindDataFile(const std::string& name, std::string& path);

/// What a name means: a file of the working folder or, where there is none, one that comes with
/// Waft (Data/Scenes/leaves-letters.waft.json). So states name their scenes, which are opened
/// anywhere.
std::string NamedFile(const std::string& name);

} // namespace waft
