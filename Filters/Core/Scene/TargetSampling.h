// SPDX-License-Identifier: BSD-3-Clause
// Few points that draw a word, a picture or a surface.
#pragma once

#include "Base/Mesh.h"
#include "Base/Result.h"
#include "Scene/SceneAssets.h"

#include <array>
#include <cstdint>
#include <vector>

namespace waft
{

/// How much each pixel wants a target, and the class that a target there belongs to.
struct TargetMask
{
  int Width = 0;
  int Height = 0;
  std::vector<float> Weights; // 0..1, x fastest, row 0 at the bottom
  std::vector<int> Classes;   // place in the list of class colours; -1 or empty: none
  double BodyWidth = 0.0;     // of what comes to lie on the targets [pixels]; 0: points

  bool IsEmpty() const;
};

/// A target in the picture's own measure: x from -0.5 to 0.5 along its width, y in the same unit.
struct PlaneTarget
{
  double X = 0.0;
  double Y = 0.0;
  int Class = -1;
};

/// The mask of a picture. Transparent pixels want nothing. A picture without transparency has a
/// background, the commonest colour of its border, and a pixel wants a target as much as its colour
/// differs from it. With class colours each pixel belongs to the nearest; one nearer to the
/// background (unless that is itself a class colour) wants nothing.
TargetMask MaskFromPicture(const Picture& picture,
                           const std::vector<std::array<double, 3>>& classColors);

/// About the distance of `count` targets in a mask of one class [pixels]: along the strokes where
/// they are thin, else of a packing of its area. 0 for an empty mask.
double TargetDistance(const TargetMask& mask, std::size_t count);

/// `count` targets, evenly spread by the weights, relaxed. Where strokes are thinner than the
/// distance of targets or than the bodies (text), the targets lie on the strokes' middle lines,
/// ends included; else they are a weighted centroidal Voronoi tessellation. Sorted by x.
/// classLimits: the most targets of each class (empty: no limit; the classes then share by weight).
/// Fails when the mask is empty or the limits leave too few.
Result SampleMask(const TargetMask& mask, std::size_t count,
                  const std::vector<std::size_t>& classLimits, std::uint64_t seed,
                  std::uint64_t stream, std::vector<PlaneTarget>& targets);

/// `count` points evenly spread over a surface by area. Fails when it has no area.
Result SampleSurface(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed,
                     std::uint64_t stream, std::vector<Vec3>& points);

} // namespace waft
