// SPDX-License-Identifier: BSD-3-Clause
// E against seconds for leaves that are planned to land as a word.
#pragma once

#include "Base/Parallel.h"

namespace waft
{

/// Plans, optimises with the standard options and a MemoryLimit (MB; 0: none), prints. Returns a
/// process' exit status.
int RunLetters(int leaves, double memoryLimit, const ParallelFor& parallel);

} // namespace waft
