// SPDX-License-Identifier: BSD-3-Clause
// The outline of what a picture shows, from its alpha.
#pragma once

#include "Base/Result.h"

#include <array>
#include <vector>

namespace waft
{

/// How opaque each pixel is, 0..1, x fastest, row 0 at the bottom.
struct AlphaMask
{
  int Width = 0;
  int Height = 0;
  std::vector<float> Values;
};

/// A closed polygon, counter-clockwise, without its first point again. Pixels: the centre of pixel
/// (i, j) is at (i + 0.5, j + 0.5).
using Polygon = std::vector<std::array<double, 2>>;

/// The outer outline of the largest connected thing where alpha is above the threshold, between
/// pixels by linear interpolation; holes are filled. Fails when the mask's size is wrong or nothing
/// of at least 16 pixels is there.
Result TraceOutline(const AlphaMask& mask, double threshold, Polygon& outline);

/// Douglas and Peucker 1973: fewer corners, nowhere farther than `tolerance` from the outline. At
/// least three corners stay.
Polygon SimplifyOutline(const Polygon& outline, double tolerance);

double SignedArea(const Polygon& polygon);

} // namespace waft
