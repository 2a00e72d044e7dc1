// SPDX-License-Identifier: BSD-3-Clause
// From a scene in metres and seconds to a problem without units.
#pragma once

#include "Constraints/Constraint.h"
#include "Constraints/Rest.h"
#include "Obstacles/ObstacleSet.h"
#include "Spacetime/HardConstraints.h"
#include "Spacetime/Spacetime.h"
#include "Spacetime/SpacetimeModel.h"
#include "Spacetime/StateVector.h"

#include <vector>

namespace waft
{

/// The problem and what leads back to the scene.
struct SpacetimeSetup
{
  SpacetimeModel Model;
  ConstraintTable Table;
  StateVector Start;          // all frames: planned tracks, gas at rest
  Vec3 Origin = Vec3::Zero(); // corner of the gas' box [m]
  double Spacing = 1.0;       // dx [m]
  double FrameStep = 1.0;     // s
  ObstacleSet Obstacles;
  std::vector<MotionObject> Objects;                // in the order of the tracks
  std::vector<std::vector<LandingWindow>> Landings; // one list an object
  std::vector<Vec3> ExactPositions; // [frame * objects + object], m, where FixedPosition
  std::vector<ReportRow> Report;    // as judged

  Vec3 ToWorld(const Vec3& x) const { return this->Origin + this->Spacing * x; }
  Vec3 FromWorld(const Vec3& x) const { return (x - this->Origin) / this->Spacing; }
  double AccelerationUnit() const { return this->Spacing / (this->FrameStep * this->FrameStep); }
};

Result MakeSetup(const SpacetimeInput& input, const SpacetimeOptions& options,
                 SpacetimeSetup& setup);

/// A vortex in dx and frames, and back.
Vortex ToModel(const SpacetimeSetup& setup, const Vortex& vortex);
Vortex ToWorld(const SpacetimeSetup& setup, const Vortex& vortex);

} // namespace waft
