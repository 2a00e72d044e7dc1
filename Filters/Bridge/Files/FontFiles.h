// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Base/Result.h"

#include <string>

namespace waft
{

/// Fails on a file that is no font with outlines, in place of which VTK would draw with its own.
Result CheckFontFile(const std::string& path);

} // namespace waft
