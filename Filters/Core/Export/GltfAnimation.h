// SPDX-License-Identifier: BSD-3-Clause
// The motion as a binary glTF 2.0 file that Blender, Houdini and game engines read: one mesh a
// shape, one animated node an object.
#pragma once

#include "Base/Monitor.h"
#include "Base/Result.h"
#include "Export/AnimatedObject.h"
#include "Export/KeyThinning.h"

#include <string>
#include <vector>

namespace waft
{

/// What the file itself says that wrote it, in the text that it begins with.
constexpr const char* GltfSign = R"("generator":"Waft")";

/// Keys of a motion far from the origin (KeyOrigin) are relative to the corner of its volume: the
/// translation of a root node, the parent of all others. glTF is y-up: a point (x, y, z) is written
/// as (x, z, -y), a quaternion (w, x, y, z) as (w, x, z, -y). Nodes are named after shape and
/// ObjectId (leaf-0, leaf-1, oak-2, ...), which is also in their extras; keys are linear, at frame
/// / framesPerSecond; a body with Sizes has them as its scale, in steps. framesPerSecond itself is
/// in the asset's extras. There is a key a frame, and one list of times for all, unless the poses
/// of all objects are more than `mostWholeKeys`: then each object has the keys and the times of
/// KeysToKeep (or all, where that takes less), and `keys` in the asset's extras says how many of
/// how many, the number of frames, and the tolerances. Materials have two sides. A shape with
/// texture and texture coordinates has the texture's colours times its Tint, cut by its alpha at
/// one half; another one has its Color. Both are made linear: a scene's colours are what a screen
/// is told (sRGB), factors of glTF are amounts of light. Fails on poses of different lengths, an
/// unknown shape, or numbers that are not finite. Objects are let go of as they are written.
Result GltfAnimation(const std::vector<AnimatedShape>& shapes, std::vector<AnimatedObject> objects,
                     double framesPerSecond, std::string& bytes, Monitor& monitor,
                     std::size_t mostWholeKeys = AnyNumberOfKeys, const Box& volume = {});

/// The same as a .glb file, whole or not at all.
Result WriteAnimationGlb(const std::string& path, const std::vector<AnimatedShape>& shapes,
                         std::vector<AnimatedObject> objects, double framesPerSecond,
                         Monitor& monitor, std::size_t mostWholeKeys = AnyNumberOfKeys,
                         const Box& volume = {});

} // namespace waft
