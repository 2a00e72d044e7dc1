// SPDX-License-Identifier: BSD-3-Clause
// What the element of a piece says of it. Private to this library.
#pragma once

#include <array>
#include <map>
#include <string_view>

namespace waft
{

using Extent = std::array<long long, 6>; // first and last of each axis

struct PieceCounts
{
  Extent Places{}; // of an image
  double Points = 0.0;
  double Cells = 0.0;
  double Rows = 0.0;
  std::map<std::string_view, double> OfKind; // Verts, Lines, Strips, Polys

  bool IsWithin(const Extent& whole) const
  {
    bool isWithin = true;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      isWithin = isWithin && this->Places[2 * axis] >= whole[2 * axis] &&
                 this->Places[2 * axis + 1] <= whole[2 * axis + 1];
    }
    return isWithin;
  }
};

} // namespace waft
