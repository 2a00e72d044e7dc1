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
  std::size_t Index = 0; // in Scene::Shapes or Scene::Obstacles
};

/// A skin that is in memory alone goes into a file of its own as well.
struct SceneSkinFile
{
  std::string Name;      // of the file, without folder; ends in .png
  std::size_t Index = 0; // in Scene::Shapes
};

struct SceneText
{
  std::string Json;
  std::vector<SceneMeshFile> Meshes;
  std::vector<SceneSkinFile> Skins;
  std::vector<std::string> NamedFiles; // paths of files that authored entries name
};

/// The text that reads back as this scene: the same shapes, objects, rows, obstacles, winds and
/// vortices, in their order, every number to the last bit.
///
/// Scene::Authored and Shape::Authored are written back entry by entry, as they are, where they
/// still make what the scene has (to 1e-12; obstacles to 1e-9 m). What was edited since, or never
/// authored, is written as numbers: objects with their positions, rows with their values, surfaces
/// as files `stem`.*.vtp, skins that were painted as files `stem`.*.png, motions of obstacles as
/// the poses at their frames. Paths of files become relative to `folder`, which is where the scene
/// file will be; relative ones of winds are so already.
///
/// What the format does not keep: rows are numbered anew, one number for each row, path or
/// keyframe, in their order; classes by their order in shapes and objects; the id of the ground; of
/// a vortex Confidence and ObjectCount; Status of rows; of a shape without authored words Damping,
/// and either Color or Tint, whichever is not seen. Targets of a group become one keyframe where
/// they are of one frame, else rows of their own objects.
///
/// Fails on what could not be read back, naming the object, row, shape, obstacle or vortex: less
/// than 2 frames, ids that stand twice, an unknown shape, a velocity of no given object, a texture
/// that is not there, and the like.
Result FormatScene(const Scene& scene, const SceneAssets& assets, const std::string& folder,
                   const std::string& stem, SceneText& text);

} // namespace waft
