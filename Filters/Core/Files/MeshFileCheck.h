// SPDX-License-Identifier: BSD-3-Clause
// Mesh files, looked at whole before a reader sees them that trusts their counts and indices.
#pragma once

#include "Base/Result.h"

#include <string_view>

namespace waft
{

// Each fails, naming the line or the element, on numbers that are missing or not finite,
// coordinates beyond limits::Coordinate (in the unit of the file), and indices of points that are
// not there.

/// STL, binary (with all the triangles of its count) or text.
Result CheckStl(std::string_view file);

} // namespace waft
