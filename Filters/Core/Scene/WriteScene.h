// SPDX-License-Identifier: BSD-3-Clause
// A scene as the text of a scene file.
#pragma once

#include "Scene/Scene.h"

#include <cstddef>
#include <string>
#include <vector>

namespace waft
{

/// A mesh that the format has no words for: it goes into a file of its own beside the scene file.
struct SceneMeshFile
{
  std::string Name;      // of the file, without folder; ends in .vtp
  bool IsShape = false;  // of a shape, else of an obstacle
  std::size_t Place = 0; // in Scene::Shapes or Scene::Obstacles
};

struct SceneText
{
  std::string Json;
  std::vector<SceneMeshFile> Meshes;
};

/// The text that reads back as this scene: the same shapes, objects, rows, obstacles, winds and
/// vortices, in their order, every number to the last bit. Built-in shapes, boxes, spheres,
/// cylinders and the ground are known again by their meshes; all other meshes go into files named
/// `stem`.*.vtp. Absolute paths of files that the scene names (textures, winds) become relative to
/// `folder`, which is where the scene file will be; relative ones of winds are so already.
///
/// What the format does not keep: rows are numbered anew, one number for each row, path or
/// keyframe, in their order; classes by their order in shapes and objects; of a vortex Confidence
/// and ObjectCount; Status of rows. Obstacle motions are kept to 1e-12 of the width. Targets of a
/// group become one keyframe where they are of one frame, else rows of their own objects.
///
/// Fails on what could not be read back, naming the object, row, shape, obstacle or vortex: less
/// than 2 frames, ids that stand twice, an unknown shape, a velocity of no given object, a texture
/// that is not there, and the like.
Result FormatScene(const Scene& scene, const SceneAssets& assets, const std::string& folder,
                   const std::string& stem, SceneText& text);

} // namespace waft
