// SPDX-License-Identifier: BSD-3-Clause
// A scene as the stages take it.
#pragma once

#include "Base/FieldSeries.h"
#include "Base/Mesh.h"
#include "Base/Result.h"
#include "Chain/ChainTable.h"
#include "Obstacles/ObstacleSet.h"
#include "Scene/Scene.h"
#include "Scene/SceneWind.h"

#include <vector>

namespace waft
{

/// Obstacles as they are seen frame after frame, in the order of their ids: where they stand at the
/// first frame, and how far from there at each. Those that never leave their place stand still.
std::vector<ObstacleMesh> ObstaclesOfFrames(const std::vector<ObstacleMesh>& obstacles,
                                            const Timeline& line);

/// The volume without what the ground takes of it [m].
Box VolumeAboveGround(const Scene& scene);

/// The quality that a scene is flown at where another is wanted: the optimiser does not know of
/// objects that come into the shot or go, nor of open sides or loops; such a scene is flown by the
/// air alone.
Quality FlownQuality(const Scene& scene, Quality wanted);

/// Reads a scene file and its winds. assets: reads what the file names. Fails as ReadScene and
/// SceneWind::Build do; what is odd is among the scene's Warnings.
Result ReadSceneAndWind(const std::string& file, const SceneAssets& assets, Scene& scene,
                        SceneWind& wind);
/// The same from the text of the file, as it is or edited.
Result ParseSceneAndWind(const std::string& text, const std::string& file,
                         const SceneAssets& assets, Scene& scene, SceneWind& wind);

} // namespace waft
