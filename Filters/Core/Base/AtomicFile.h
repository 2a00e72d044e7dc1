// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Base/Result.h"

#include <string>

namespace waft
{

/// Writes a file whole or not at all: under a name of its own beside it, then renamed over it. On
/// failure what stood there before is untouched and nothing is left behind; the message names the
/// path and the system's reason.
Result WriteWholeFile(const std::string& path, const std::string& bytes);

} // namespace waft
