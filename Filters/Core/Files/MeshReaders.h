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
/// Stanford PLY, ascii or binary: one element `vertex` with x, y, z, one element `face` with a list
/// of indices, and all the others that its header names are there, in text on a line of its own
/// each. Points are rounded to floats. Texture coordinates are those of points (u and v, or s and
/// t), or those of corners (a list `texcoord`).
Result ReadPly(std::string_view file, PolygonSurface& surface);
/// STL, binary where the size is that of its triangles, or text in letters of any case. Equal
/// points, rounded to floats, are one; triangles with a corner twice are left out.
Result ReadStl(std::string_view file, PolygonSurface& surface);

} // namespace waft
