// SPDX-License-Identifier: BSD-3-Clause
// From a scene in metres and seconds to a problem without units.
#pragma once

#include "Constraints/Constraint.h"
#include "Constraints/Rest.h"
#include "Obstacles/ObstacleSet.h"
#include "Spacetime/Model/ConstraintTable.h"
#include "Spacetime/Model/SpacetimeModel.h"
#include "Spacetime/Model/SpacetimeOptions.h"
#include "Spacetime/Model/SpacetimeUnits.h"
#include "Spacetime/Model/StateVector.h"
#include "Spacetime/Scene/SpacetimeInput.h"

#include <vector>

namespace waft
{

/// The problem and what leads back to the scene.
struct SpacetimeSetup : SpacetimeUnits
{
  SpacetimeModel Model;
  ConstraintTable Table;
  StateVector Start; // all frames: planned tracks, gas at rest
  ObstacleSet Obstacles;
  std::vector<MotionObject> Objects;                // in the order of the tracks
  std::vector<std::vector<LandingWindow>> Landings; // one list an object
  std::vector<std::vector<LandingWindow>> Exempts;  // likewise, and that in which it hangs
  std::vector<Vec3> ExactPositions; // [frame * objects + object], m, where FixedPosition
  std::vector<ReportRow> Report;    // as judged
};

Result MakeSetup(const SpacetimeInput& input, const SpacetimeOptions& options,
                 SpacetimeSetup& setup);

} // namespace waft
