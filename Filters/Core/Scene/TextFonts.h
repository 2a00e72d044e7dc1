// SPDX-License-Identifier: BSD-3-Clause
// The fonts that come with the reader; any other name is a file.
#pragma once

#include <string>

namespace waft
{

inline bool IsFontFamily(const std::string& font)
{
  return font == "sans" || font == "serif" || font == "mono";
}

} // namespace waft
