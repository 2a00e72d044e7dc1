// SPDX-License-Identifier: BSD-3-Clause
// Smoke as an image, and obstacles as the smoke solver reads them.
#pragma once

#include "Base/Mesh.h"
#include "Base/Result.h"
#include "Grid/SmokeSeries.h"

#include <array>
#include <vector>

class vtkImageData;

namespace waft
{

/// Voxel centres become the image's points. Point data `Velocity`, `Vorticity`, `VortexForce`,
/// `WindForce` (float[3]), `Density`, `Pressure` (float), `Obstacle` (unsigned char).
void SmokeFrameToImage(const SmokeFrame& frame, const SceneInfo& info, vtkImageData* data);

/// Signed distances at the nodes of a grid of these options, and, when an obstacle moves, the
/// velocity of the nearest one at the nodes in or near it (empty lists without obstacles).
/// May be called by several threads. Frames of a small grid are computed once and kept: many coarse
/// runs are made among the same obstacles.
SolidsAtFrame NodeSolids(std::vector<ObstacleMesh> obstacles, const SmokeOptions& options);

} // namespace waft
