// SPDX-License-Identifier: BSD-3-Clause
// The one way in which files are written: whole or not at all.
#pragma once

#include "Base/Result.h"

#include <cstdio>
#include <string>
#include <vector>

namespace waft
{

/// A file on its way to its place: written under a name of its own beside it, `PATH.part` and a
/// number by chance, which nothing had before, then renamed over it. Until then what stood there
/// before is untouched; without that nothing is left behind. Errors name the path and the system's
/// reason.
class PartFile
{
public:
  explicit PartFile(const std::string& path);
  ~PartFile();
  PartFile(const PartFile&) = delete;
  void operator=(const PartFile&) = delete;

  /// Where it is written, for libraries that open their files themselves: an empty file, unless it
  /// cannot be made. Others call Open, Write and Close.
  const std::string& Name();
  bool Open();
  /// After an Open that was true.
  bool Write(const void* bytes, std::size_t size);
  /// All of it is on the disk, or an error, also the one of an Open or Write before.
  Result Close();
  Result PutInPlace();

private:
  bool Make();
  bool Fail();
  Result Failure() const;

  std::string Path, Part;
  std::FILE* File = nullptr;
  bool IsMade = false;
  int Reason = 0; // of the first failure
  bool IsInPlace = false;
};

/// Writes a file of these bytes as a PartFile.
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
