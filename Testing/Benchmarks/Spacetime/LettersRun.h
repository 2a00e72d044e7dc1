// SPDX-License-Identifier: BSD-3-Clause
// E against seconds for leaves that are planned to land as a word.
#pragma once

#include "Base/Parallel.h"

namespace waft
{

/// Plans, optimises with the standard options and a MemoryLimit (MB; 0: none), prints; then, where
/// it edits, moves one target and goes on. Returns a process' exit status.
int RunLetters(int leaves, bool edits, double memoryLimit, const ParallelFor& parallel);

} // namespace waft
