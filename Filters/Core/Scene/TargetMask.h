// SPDX-License-Identifier: BSD-3-Clause
// What of a picture wants targets, and of which class.
#pragma once

#include "Scene/SceneAssets.h"

#include <array>
#include <string>
#include <vector>

namespace waft
{

/// How much each pixel wants a target, and the class that a target there belongs to.
struct TargetMask
{
  int Width = 0;
  int Height = 0;
  std::vector<float> Weights; // 0..1, x fastest, row 0 at the bottom
  std::vector<int> Classes;   // index in the list of class colours; -1 or empty: none
  double BodyWidth = 0.0;     // of what comes to lie on the targets [pixels]; 0: points

  bool IsEmpty() const;
};

/// What is odd about a picture whose outline is to be its transparency, a sentence; empty: nothing.
/// One that is clear in a corner only would be a full rectangle of targets.
std::string RemarkOnTransparency(const Picture& picture);

/// The mask of a picture. Transparent pixels want nothing. A picture without transparency has a
/// background, the commonest colour of its border, and a pixel wants a target as much as its colour
/// differs from it. With class colours each pixel belongs to the nearest; one nearer to the
/// background (unless that is itself a class colour) wants nothing.
TargetMask MaskFromPicture(const Picture& picture,
                           const std::vector<std::array<double, 3>>& classColors);

} // namespace waft
