// SPDX-License-Identifier: BSD-3-Clause
// Names of the files of a time series.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace waft
{

/// The files of the series that a name stands for, with their frames, in order: all files in its
/// folder that differ from it in the digits at the end of the stem alone ("smoke_0012.vdb"); the
/// digits are the frame. A name without digits stands for itself, as frame 0. Empty when the folder
/// has no such file.
std::vector<std::pair<int, std::string>> SeriesFiles(const std::string& path);

/// The name of a frame's file: "smoke.vdb" gives "smoke_0012.vdb".
std::string SeriesFile(const std::string& path, int frame);

} // namespace waft
