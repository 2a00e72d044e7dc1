// SPDX-License-Identifier: BSD-3-Clause
// The files of a time series.
#pragma once

#include "Volumes/VolumeFile.h"

#include <string>
#include <utility>
#include <vector>

namespace waft
{

/// The files of the series that a name stands for, with their frames, in order: all files in its
/// folder that differ from it in one number of the stem alone ("smoke_0012.vdb",
/// "smoke_0012_v2.vdb"), which is the frame. Where they differ in several numbers it is the one of
/// most digits, of these the last. A name without others is its own series: its frame is the number
/// at the end of the stem, 0 without one. Empty when the folder has no such file.
std::vector<std::pair<int, std::string>> SeriesFiles(const std::string& path);

/// What is in each of these files. Fails, naming the file, when one cannot be read or when two are
/// of one frame.
Result ListSeries(const std::vector<std::pair<int, std::string>>& files,
                  std::vector<VolumeContents>& contents);

/// The name of a frame's file: "smoke.vdb" gives "smoke_0012.vdb".
std::string SeriesFile(const std::string& path, int frame);

} // namespace waft
