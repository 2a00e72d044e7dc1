// SPDX-License-Identifier: BSD-3-Clause
// Motion databases of files, and that which comes with Waft.
#pragma once

#include "Base/Result.h"
#include "Trajectory/MotionDatabase.h"

#include <string>

namespace waft
{

/// Reads a motion database of a .vtm. A failure's message begins with its path.
Result ReadDatabaseFile(const std::string& path, MotionDatabase& database);
/// Reads the motion database that comes with Waft. A failure's message begins with its path.
Result ReadEmbeddedDatabase(MotionDatabase& database);

} // namespace waft
