// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace waft
{

/// The bytes of a PNG file, 8-bit RGBA, each row filtered by the row above. pixels: red, green,
/// blue, alpha, x fastest, row 0 at the bottom.
std::string EncodePng(const std::vector<std::uint8_t>& pixels, int width, int height);

/// The bytes of a PNG file with a text before its end (chunk tEXt: Latin-1, a keyword of 1 to 79
/// characters).
std::string WithPngText(const std::string& png, const std::string& keyword,
                        const std::string& text);

} // namespace waft
