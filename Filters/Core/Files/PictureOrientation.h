// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace waft
{

/// How a picture is to be turned to be seen as it was taken: field 274 (Orientation) of a TIFF, or
/// of the Exif in a JPEG or a PNG. 1: as it is stored, 2: mirrored, 3: turned by half, 4: upside
/// down, 5 to 8: the same with rows and columns exchanged. 1 where the file does not say, or not
/// well.
int PictureOrientation(std::string_view file);

} // namespace waft
