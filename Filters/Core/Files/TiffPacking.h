// SPDX-License-Identifier: BSD-3-Clause
// What TIFF strips are packed by. Private to this library.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace waft
{

/// Numbers of the format's ways to pack a strip.
enum class TiffPacking : std::uint64_t
{
  None = 1,
  Lzw = 5,
  Deflate = 8,
  PackBits = 32773,
  OldDeflate = 32946
};

bool IsKnownPacking(std::uint64_t packing);

/// Unpacks the first `size` bytes of a strip or tile; false when it has fewer or is damaged.
bool UnpackTiff(TiffPacking packing, std::string_view packed, std::size_t size, std::string& bytes);

} // namespace waft
