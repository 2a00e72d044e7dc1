// SPDX-License-Identifier: BSD-3-Clause
// Obstacles as the smoke solver reads them.
#pragma once

#include "Base/Mesh.h"
#include "Grid/SmokeSeries.h"

#include <vector>

namespace waft
{

/// Signed distances at the nodes of a grid of these options, and, when an obstacle moves, the
/// velocity of the nearest one at the nodes in or near it (empty lists without obstacles).
/// May be called by several threads. Frames of a small grid are computed once and kept: many coarse
/// runs are made among the same obstacles.
SolidsAtFrame NodeSolids(std::vector<ObstacleMesh> obstacles, const SmokeOptions& options);

} // namespace waft
