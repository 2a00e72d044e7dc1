// SPDX-License-Identifier: BSD-3-Clause
// Few points that draw a word or a picture.
#pragma once

#include "Base/Result.h"
#include "Scene/TargetMask.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace waft
{

/// A target in the picture's own measure: x from -0.5 to 0.5 along its width, y in the same unit.
struct PlaneTarget
{
  double X = 0.0;
  double Y = 0.0;
  int Class = -1;
};

/// About the distance of `count` targets in a mask of one class [pixels]: along the strokes where
/// they are thin, else of a packing of its area. 0 for an empty mask.
double TargetDistance(const TargetMask& mask, std::size_t count);

/// `count` targets, evenly spread by the weights, relaxed. Where strokes are thinner than the
/// distance of targets or than the bodies (text), the targets lie on the strokes' middle lines,
/// ends included; else they are a weighted centroidal Voronoi tessellation. Sorted by x.
/// classLimits: the most targets of each class (empty: no limit; then divided among classes by
/// weight). Fails when the mask is empty or the limits leave too few.
Result SampleMask(const TargetMask& mask, std::size_t count,
                  const std::vector<std::size_t>& classLimits, std::uint64_t seed,
                  std::uint64_t stream, std::vector<PlaneTarget>& targets);

} // namespace waft
