// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Base/Result.h"
#include "Trajectory/MotionDatabase.h"

namespace waft
{

/// Reads the motion database that comes with Waft. A failure's message begins with its path.
Result ReadEmbeddedDatabase(MotionDatabase& database);

} // namespace waft
