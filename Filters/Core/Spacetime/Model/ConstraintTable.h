// SPDX-License-Identifier: BSD-3-Clause
// What must be met exactly.
#pragma once

#include "Constraints/LinearCluster.h"
#include "Spacetime/Model/SpacetimeModel.h"

#include <vector>

namespace waft
{

/// All requirements of a problem, in dx and frames.
struct ConstraintTable
{
  /// Exact positions, of those (frame, object) flagged FixedPosition [frame * objects + object].
  std::vector<Vec3> FixedPositions;
  std::vector<PositionBall> Balls;
  std::vector<DifferenceRow> Rows;
  /// Planned positions [frame * objects + object], centres of the leash.
  std::vector<Vec3> Planned;
};

/// Groups the rows of each object that share free frames, of those whose frames are all there.
std::vector<LinearCluster> MakeClusters(const SpacetimeModel& model, const ConstraintTable& table,
                                        const std::vector<bool>& hasFrame);

} // namespace waft
