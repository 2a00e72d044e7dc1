// SPDX-License-Identifier: BSD-3-Clause
// TIFF pictures, read whole: what the decoders at hand make of transparency and of inverted greys
// is not what the format says.
#pragma once

#include "Base/Result.h"

#include <string_view>
#include <vector>

namespace waft
{

/// A picture of 8 bits a channel, the first row of the file first.
struct PictureBytes
{
  int Width = 0;
  int Height = 0;
  int Channels = 0; // grey or red, green, blue, and alpha behind them where there is one
  std::vector<unsigned char> Values;
};

/// The first picture of a TIFF of 8 or 16 bits a channel: grey, colour or a palette, with alpha or
/// without, in strips or tiles, interleaved or in planes; not packed, or by PackBits, LZW or
/// Deflate. Colours that are multiplied by alpha are divided by it. Fails on any other and on what
/// is cut or damaged.
Result ReadTiff(std::string_view file, PictureBytes& picture);

} // namespace waft
