// SPDX-License-Identifier: BSD-3-Clause
// A motion database as one file that Core reads by itself. The data set that is looked at and
// passed on is VTK's (.vtm); this is for programs without VTK.
#pragma once

#include "Base/Result.h"
#include "Trajectory/MotionDatabase.h"

#include <string>

namespace waft
{

/// Every number as it is, in the machine's own order of bytes, a checksum at the end; whole or not
/// at all. Errors name the path and the reason.
Result WriteDatabase(const std::string& path, const MotionDatabase& database);

/// Fails with the path where there is no such file, where it is damaged or of another version, and
/// where what it holds is no database (MotionDatabase::Validate); database is then empty.
Result ReadDatabase(const std::string& path, MotionDatabase& database);

} // namespace waft
