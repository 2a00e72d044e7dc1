// SPDX-License-Identifier: BSD-3-Clause
// The scenes of Data/Scenes as scenes to plan in.
#pragma once

#include "../Scene/TestAssets.h"
#include "Constraints/Constraint.h"
#include "PlanScenes.h"
#include "Scene/SceneReader.h"

namespace waft
{
namespace test
{

/// name: without the ending .waft.json.
inline PlanScene LoadPlanScene(const std::string& name)
{
  Scene file;
  PlanScene::Check(ReadScene(std::string(WAFT_SOURCE_DIR) + "/Data/Scenes/" + name + ".waft.json",
                             TestAssets(), file));
  PlanScene scene;
  scene.Objects = file.Objects;
  scene.Constraints = file.Constraints;
  scene.Meshes = file.Obstacles;
  scene.Scene = file.Info;
  return scene;
}

/// Frames of flight: those from the second before a rest on are left out.
inline int FreeFrames(const PlanScene& scene)
{
  int frames = scene.Scene.Time.NumberOfFrames;
  for (const Constraint& row : scene.Constraints)
  {
    if (row.Kind == ConstraintKind::Rest)
    {
      frames = std::min(frames, row.Frame - static_cast<int>(scene.Scene.Time.FramesPerSecond));
    }
  }
  return frames;
}

} // namespace test
} // namespace waft
