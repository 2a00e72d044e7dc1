// SPDX-License-Identifier: BSD-3-Clause
// From the solver's state to tracks in double precision that meet every requirement, and the
// fields at them.
#pragma once

#include "Spacetime/Energy/SpacetimeObjective.h"
#include "Spacetime/Model/EditRegion.h"
#include "Spacetime/Scene/SpacetimeOutput.h"
#include "Spacetime/Scene/SpacetimeSetup.h"

#include <vector>

namespace waft
{

/// What a local edit leaves as it was: all outside its region. Both null: nothing.
struct KeptMotion
{
  const EditRegion* Region = nullptr;
  const std::vector<std::vector<Vec3>>* Positions = nullptr; // by object and frame [m]
};

/// Positions by object and frame [m]: exact rows bit-identical, balls and linear rows met in
/// double, and swept clearance kept: where it is not the motion is moved away from the obstacle,
/// and falls back towards the planned path where that is not enough. The state is brought to the
/// same positions. warnings: objects whose clearance could not be kept.
std::vector<std::vector<Vec3>> ExportPositions(const SpacetimeInput& input,
                                               const SpacetimeSetup& setup, const KeptMotion& kept,
                                               StateVector& state,
                                               std::vector<std::string>& warnings);

/// Fills Tracks (fields, air, raw velocities), Particles, Vortices and Wind of the output, and says
/// how far it is a motion of the model, unless the monitor has stopped it (false). objective:
/// evaluated at the state.
bool ExportFields(const SpacetimeInput& input, const SpacetimeSetup& setup,
                  SpacetimeObjective& objective, const StateVector& state,
                  const std::vector<std::vector<Vec3>>& positions, Monitor& monitor,
                  SpacetimeOutput& output);

} // namespace waft
