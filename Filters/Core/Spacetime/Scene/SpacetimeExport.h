// SPDX-License-Identifier: BSD-3-Clause
// From the solver's state to tracks in double precision that meet every requirement, and the
// fields at them.
#pragma once

#include "Spacetime/Energy/SpacetimeObjective.h"
#include "Spacetime/Scene/SpacetimeOutput.h"
#include "Spacetime/Scene/SpacetimeSetup.h"

#include <cstddef>
#include <vector>

namespace waft
{

/// Positions of all objects at all frames of a level [level frame * objects + object].
std::vector<Vec3> ObjectPositions(const SpacetimeModel& model, std::size_t frames,
                                  const StateVector& state);

/// Positions by object and frame [m]: exact rows bit-identical, balls and linear rows met in
/// double, and swept clearance kept: where it is not the motion is moved away from the obstacle,
/// and falls back towards the planned path where that is not enough. The state is brought to the
/// same positions. warnings: objects whose clearance could not be kept.
std::vector<std::vector<Vec3>> ExportPositions(const SpacetimeInput& input,
                                               const SpacetimeSetup& setup, StateVector& state,
                                               std::vector<std::string>& warnings);

/// A motion's Tracks (fields, air, raw velocities), Particles, Vortices and Wind, and how far it is
/// one of the model.
class FieldExport
{
public:
  /// The setup and the state must outlive it.
  FieldExport(const SpacetimeInput& input, const SpacetimeSetup& setup, const StateVector& state);

  /// Takes what the terms say of a frame, all of which are to be visited once. Any thread.
  void Visit(std::size_t frame, FrameTerms& terms);
  /// objective: evaluated at the state, all frames visited. False: the monitor stopped it, and how
  /// far it is a motion of the model is not said.
  bool Write(SpacetimeObjective& objective, const std::vector<std::vector<Vec3>>& positions,
             Monitor& monitor, SpacetimeOutput& output);

private:
  struct ObjectAir // about an object at a frame, in dx and frames
  {
    double Witness = 0.0; // how much of the density there is the gas'
    Vec3 Relative, Vortex, Wind;
  };
  /// What moves an object in a sampled air beside it, from the frame before on: the gas' deviation
  /// that is felt there, and the control that neither air nor gas gives [dx / frame].
  struct AirDeviation
  {
    Vec3 Gas = Vec3::Zero();
    Vec3 Control = Vec3::Zero();
  };
  void AppendResidual(const SpacetimeObjective& objective, int frame, std::size_t object,
                      const Vec3& controlBefore, const Vec3& control, Track& track) const;
  void AppendObjects(const SpacetimeObjective& objective, int frame,
                     std::vector<AirDeviation>& deviations, std::vector<Track>& tracks) const;
  void AddResiduals(const SpacetimeObjective& objective, int frame,
                    const std::vector<Track>& tracks);

  const SpacetimeInput& Input;
  const SpacetimeSetup& Setup;
  const StateVector& State;
  std::vector<ParticleSeries::Frame> Frames;
  std::vector<ObjectAir> Objects; // [frame * objects + object]
};

} // namespace waft
