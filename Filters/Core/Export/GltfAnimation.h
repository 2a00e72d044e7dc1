// SPDX-License-Identifier: BSD-3-Clause
// The motion as a binary glTF 2.0 file that Blender, Houdini and game engines read: one mesh a
// shape, one animated node an object.
#pragma once

#include "Base/Monitor.h"
#include "Base/Result.h"
#include "Base/Shape.h"
#include "Export/ImageFile.h"

#include <array>
#include <string>
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
};

/// glTF is y-up: a point (x, y, z) is written as (x, z, -y), a quaternion (w, x, y, z) as
/// (w, x, z, -y). Nodes are named after shape and ObjectId (leaf-0, leaf-1, oak-2, ...), which is
/// also in their extras; keys are linear, at frame / framesPerSecond, and share one list of times;
/// framesPerSecond itself is in the asset's extras. Materials have two sides. A shape with texture
/// and texture coordinates has the texture's colours times its Tint, cut by its alpha at one half;
/// another one has its Color. Both are made linear: a scene's colours are what a screen is told
/// (sRGB), factors of glTF are amounts of light. Fails on poses of different lengths, an unknown
/// shape, or numbers that are not finite. Objects are let go of as they are written.
Result GltfAnimation(const std::vector<AnimatedShape>& shapes, std::vector<AnimatedObject> objects,
                     double framesPerSecond, std::string& bytes, Monitor& monitor);

/// The same as a .glb file, whole or not at all.
Result WriteAnimationGlb(const std::string& path, const std::vector<AnimatedShape>& shapes,
                         std::vector<AnimatedObject> objects, double framesPerSecond,
                         Monitor& monitor);

} // namespace waft
