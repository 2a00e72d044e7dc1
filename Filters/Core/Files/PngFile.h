// SPDX-License-Identifier: BSD-3-Clause
// PNG files, looked at whole before a decoder sees them.
#pragma once

#include "Base/Result.h"

#include <string>
#include <string_view>

namespace waft
{

/// `sound` becomes the same picture with nothing but what its pixels need. Fails, naming the chunk,
/// on a wrong header, a chunk that is cut, missing or misplaced, a wrong checksum, and on pixels
/// that do not unpack to the size of the header (PNG specification, second edition, sections 5, 9
/// and 10).
Result SoundPng(std::string_view file, std::string& sound);

} // namespace waft
