// SPDX-License-Identifier: BSD-3-Clause
// Mesh files in memory, read and checked at once.
#pragma once

#include "Base/Result.h"
#include "Files/PolygonSurface.h"

#include <string_view>

namespace waft
{

// Each fails, naming the line or the element, on numbers that are missing or not finite,
// coordinates beyond limits::Coordinate (in the unit of the file), and indices of points that are
// not there. Texts may begin with a byte order mark, and their lines end in LF, CR LF or CR.

/// Wavefront OBJ: its lines v, vt and f; the indices of l and p and of normals are looked at. Lines
/// may go on behind a backslash and end in a comment. Texture coordinates are kept where all
/// corners have one.
Result ReadObj(std::string_view file, PolygonSurface& surface);

} // namespace waft
