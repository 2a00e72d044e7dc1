// SPDX-License-Identifier: BSD-3-Clause
// What an animation shows: shapes, and objects that move.
#pragma once

#include "Base/Result.h"
#include "Base/Shape.h"
#include "Export/ImageFile.h"
#include "Export/KeyThinning.h"

#include <vector>

namespace waft
{

/// A shape and its texture.
struct AnimatedShape
{
  Shape Body;                // z up, metres
  std::vector<Vec3> Normals; // one a point; empty: made from the triangles
  ImageFile Texture;         // embedded; without it, or without texture coordinates, Body.Color
};

/// An object and its motion, one sample a frame; z up.
struct AnimatedObject
{
  int ObjectId = 0;
  std::size_t Shape = 0; // index in the list of shapes
  std::vector<Vec3> Positions;
  std::vector<Quat> Orientations; // body to world, unit
  std::vector<int> Marks = {};    // frames whose keys stay when keys are thinned
  std::vector<float> Sizes = {};  // of its own, 0 to 1; empty: its own throughout
  int LoopTo = -1;                // the ObjectId as which it begins anew; -1: none
};

/// A point or a direction by the axes of glTF.
inline Vec3 ToYUp(const Vec3& v)
{
  return Vec3(v.x(), v.z(), -v.y());
}

/// Where places in keys are relative to, z up: the origin, or the lowest corner of a volume so far
/// from it that numbers of 32 bits there are coarser than 1e-6 of its width.
Vec3 KeyOrigin(const Box& volume);

/// The keys of an object at all frames, y up.
BodyKeys KeysOf(const AnimatedObject& object, double framesPerSecond, const Vec3& origin);

/// Fails on poses of different lengths, an unknown shape, a mesh that is not one, or numbers that
/// are not finite.
Result CheckAnimated(const std::vector<AnimatedShape>& shapes,
                     const std::vector<AnimatedObject>& objects);

} // namespace waft
