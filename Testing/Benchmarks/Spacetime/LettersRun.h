// SPDX-License-Identifier: BSD-3-Clause
// E against seconds for leaves that are planned to land as a word.
#pragma once

#include "Base/Parallel.h"

namespace waft
{

/// Plans, optimises with the standard options, prints; returns a process' exit status.
int RunLetters(int leaves, const ParallelFor& parallel);

} // namespace waft
