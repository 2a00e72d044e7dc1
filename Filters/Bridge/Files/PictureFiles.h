// SPDX-License-Identifier: BSD-3-Clause
// Pictures from files.
#pragma once

#include "Base/Result.h"

#include <string>
#include <string_view>

class vtkImageData;

namespace waft
{

/// Is this the name of a picture (.png, .jpg, .jpeg, .tif, .tiff, .bmp)?
bool IsPictureName(const std::string& path);

/// A picture of at most 2^26 pixels, as its pixels are stored: textures and their coordinates go by
/// these. Fails on another name, another kind of file than the name says, and what is cut or
/// damaged.
Result ReadPictureFile(const std::string& path, vtkImageData* image);

/// The same as it is seen: turned as the file says (cameras note how they were held).
Result ReadUprightPicture(const std::string& path, vtkImageData* image);

/// The bytes of a PNG file, looked at and read as ReadPictureFile does it.
Result ReadPng(std::string_view bytes, vtkImageData* image);

} // namespace waft
