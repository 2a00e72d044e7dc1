// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Base/Result.h"

#include <string>

namespace waft
{

/// The bytes of an image as they stand in its file, but for notes of how a camera was held.
struct ImageFile
{
  std::string Bytes;    // empty: no image
  std::string MimeType; // image/png or image/jpeg
};

/// Fails when the file cannot be read or is neither PNG nor JPEG; the message names it.
Result ReadImageFile(const std::string& path, ImageFile& image);

} // namespace waft
