// SPDX-License-Identifier: BSD-3-Clause
// The texts and pictures that a scene's keyframes draw, where they stand.
#pragma once

#include "Base/Types.h"
#include "Scene/TargetMask.h"

#include <string>
#include <vector>

namespace waft
{

/// What the targets of a row draw: its mask's pixels are Width / Mask.Width wide, and the picture's
/// middle is at Origin.
struct SceneDrawing
{
  int Row = 0;
  Vec3 Origin = Vec3::Zero(); // m
  Vec3 U = Vec3::UnitX();     // unit directions of width and height
  Vec3 V = Vec3::UnitY();
  double Width = 1.0; // m
  TargetMask Mask;
};

/// The drawings of a scene file, in the order of its rows: of texts as their letters are set, of
/// pictures; targets that are points or of a mesh draw none. Fails as ReadScene does.
Result ReadDrawings(const std::string& file, const SceneAssets& assets,
                    std::vector<SceneDrawing>& drawings);

} // namespace waft
