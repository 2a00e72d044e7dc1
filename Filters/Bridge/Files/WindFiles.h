// SPDX-License-Identifier: BSD-3-Clause
// Winds from files, whole series at once.
#pragma once

#include "Base/FieldSeries.h"
#include "Base/Types.h"

#include <string>

namespace waft
{

/// A wind from a .vti (one time, which then holds throughout), a .pvd (a series of .vti) or a .vdb,
/// with the point data or vector grid `Wind` or `Velocity`. A .vdb whose name ends in digits stands
/// for the series of all files in its folder that differ in these digits alone; they are the frame.
Result ReadWindFile(const std::string& path, const Timeline& line, FieldSeries& wind);

} // namespace waft
