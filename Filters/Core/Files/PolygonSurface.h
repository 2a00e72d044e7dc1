// SPDX-License-Identifier: BSD-3-Clause
// Polygons and their points as a mesh file has them.
#pragma once

#include "Base/Types.h"

#include <array>
#include <cstddef>
#include <vector>

namespace waft
{

/// Most points of a surface from a file, and most of its triangles.
constexpr std::size_t MostOfASurface = 20'000'000;
/// Most corners of a polygon: what splits it into triangles takes the square of them.
constexpr std::size_t MostCorners = 4096;

using TextureCoordinate = std::array<double, 2>;

struct PolygonSurface
{
  std::vector<Vec3> Points;
  std::vector<TextureCoordinate> TextureCoordinates; // one a point, or none; rounded to floats
  std::vector<int> Corners;                          // indices of points, polygon after polygon
  std::vector<std::size_t> Ends;                     // behind the last corner of each polygon

  /// Gives each corner its texture coordinate, rounded to floats. Points keep their indices; one
  /// with several is there once for each, the others behind all points.
  void SetCornerCoordinates(const std::vector<TextureCoordinate>& ofCorners);
};

} // namespace waft
