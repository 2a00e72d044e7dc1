// SPDX-License-Identifier: BSD-3-Clause
// Painted skins of thin shapes, made from the same outlines as their meshes.
#pragma once

#include "Base/Result.h"
#include "Shapes/Outline.h"

#include <array>
#include <cstdint>
#include <vector>

namespace waft
{

struct TextureOptions
{
  int Width = 512;                                // pixels along the body's length, 16..4096
  int Height = 256;                               // pixels across
  std::array<double, 3> Base{ 0.45, 0.56, 0.18 }; // colour near the middle rib, 0..1
  std::array<double, 3> Edge{ 0.70, 0.55, 0.15 }; // colour of the edges and of blotches
  std::array<double, 3> Vein{ 0.75, 0.75, 0.45 }; // colour of ribs and veins, or of the shaft
  double Blotches = 0.5;                          // how much of Edge comes in blotches, 0..1
  std::uint64_t Seed = 1;

  Result Validate() const;
};

/// Red, green, blue, alpha bytes, row 0 at the bottom (v = 0), x fastest. Alpha is 0 outside the
/// outline, between the teeth of a leaf and in the splits of a feather.
Result PaintTexture(const Outline& outline, const TextureOptions& options,
                    std::vector<std::uint8_t>& pixels);

} // namespace waft
