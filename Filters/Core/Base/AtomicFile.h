// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Base/Result.h"

#include <string>
#include <vector>

namespace waft
{

/// Writes a file whole or not at all: under a name of its own beside it, then renamed over it. On
/// failure what stood there before is untouched and nothing is left behind; the message names the
/// path and the system's reason.
Result WriteWholeFile(const std::string& path, const std::string& bytes);

/// A file's path and what is to be in it.
struct FileContent
{
  std::string Path;
  std::string Bytes;
};

/// Writes several files that belong together: all of them beside their places first, then each
/// renamed over it, in their order. Folders that are missing are made. On a failure before the
/// first renaming (no room, no permission) nothing has changed and nothing is left behind.
Result WriteWholeFiles(const std::vector<FileContent>& files);

} // namespace waft
