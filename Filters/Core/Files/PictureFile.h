// SPDX-License-Identifier: BSD-3-Clause
// Pictures, looked at before a decoder sees them: kind, size, and that they are whole.
#pragma once

#include "Base/Result.h"

#include <cstdint>
#include <string_view>

namespace waft
{

/// Most pixels of a picture that is read, and most bytes of them once they are unpacked.
constexpr std::uint64_t MostPixels = std::uint64_t{ 1 } << 26;
constexpr std::uint64_t MostPixelBytes = std::uint64_t{ 1 } << 28;

/// At least one pixel, at most MostPixels and MostPixelBytes. pixelBytes: of an unpacked one.
Result CheckPictureSize(std::uint64_t width, std::uint64_t height, std::uint64_t pixelBytes);

/// Is a JPEG in grey or colour with a frame header of a size that may be read? What its data hold
/// the decoder says.
Result CheckJpeg(std::string_view file);
/// Is a BMP of 8 or 24 bits a pixel, uncompressed, with all its rows?
Result CheckBmp(std::string_view file);

} // namespace waft
