// SPDX-License-Identifier: BSD-3-Clause
// Files of blocks whose own files keep their values behind their elements, for VTK's reader.
#pragma once

#include "Base/Result.h"

#include <filesystem>
#include <string>

namespace waft
{

/// VTK's reader of a multi-block data set reads the files of the blocks by itself. Where their
/// values are appended, this is a copy with these within the elements (Files/InlineData.h says
/// why), in a temporary folder that goes with it.
class InlinedBlocks
{
public:
  InlinedBlocks() = default;
  ~InlinedBlocks();
  InlinedBlocks(const InlinedBlocks&) = delete;
  InlinedBlocks& operator=(const InlinedBlocks&) = delete;

  /// Of a file that CheckDataFile has found whole; errors name what cannot be read or written.
  Result Make(const std::string& path);
  /// The copy, or the file itself where it needs none.
  const std::string& Path() const { return this->File; }

private:
  /// The block becomes its copy where it needs one.
  Result Keep(std::filesystem::path& block);

  std::string File;
  std::filesystem::path Folder; // empty: no copy
  int Copies = 0;
};

} // namespace waft
