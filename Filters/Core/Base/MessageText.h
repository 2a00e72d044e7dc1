// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace waft
{

/// A message that any reader can take: valid UTF-8 (what is none becomes U+FFFD, control characters
/// but line breaks and tabs an escape) of at most 1800 bytes (a longer one loses its middle).
/// Messages quote files and values, which may hold anything.
std::string MessageText(const std::string& text);

} // namespace waft
