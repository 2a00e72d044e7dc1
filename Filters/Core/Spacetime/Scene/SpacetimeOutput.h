// SPDX-License-Identifier: BSD-3-Clause
// What a run gives, in world units.
#pragma once

#include "Base/FieldSeries.h"
#include "Base/ForceFields.h"
#include "Base/Motion.h"
#include "Base/StateArchive.h"
#include "Base/Types.h"
#include "Constraints/ConstraintCheck.h"
#include "Spacetime/Energy/Convergence.h"

#include <string>
#include <vector>

namespace waft
{

/// All particles, gas first, then the objects' in the order of the tracks. World units.
struct ParticleSeries
{
  struct Frame
  {
    std::vector<float> Positions, Velocities; // three each
    std::vector<float> Densities, Pressures;  // kg/m^3, Pa
    std::vector<float> Winds, VortexForces;   // three each, m/s^2
    std::vector<float> Residuals;             // three each: what no term gives [m/s^2]
  };
  std::vector<int> ObjectIds; // -1: gas
  std::vector<float> Masses;  // kg, as the SPH sums weigh them
  std::vector<Frame> Frames;
};

struct SpacetimeOutput
{
  std::vector<Track> Tracks; // in the order of the input
  ParticleSeries Particles;
  std::vector<Vortex> Vortices;
  FieldSeries Wind; // estimated plus the user's acceleration, on the wind's lattice; zero without
  std::vector<ConvergenceRow> Convergence;
  std::vector<ReportRow> Report;
  std::vector<double> PositionResiduals; // rms of x against its prediction by object [dx]
  std::vector<double> VelocityResiduals; // the same of v [dx / frame]
  double Spacing = 0.0;                  // dx [m]
  /// How far it is a motion of the model. ReplayErrors: of objects and gas, a second after they
  /// were let go (Rollout.h); GasHiddenHand: rms of the gas' Residuals over that of Dv/Dt.
  /// Negative: not to be had.
  double ObjectReplayError = -1.0, GasReplayError = -1.0, GasHiddenHand = -1.0;
  /// Of all frames of all objects, those that were moved after solving by more than 1e-5 of the
  /// volume's width, so that all that is asked for holds; and by how much at most [m].
  double RepairedFraction = 0.0, LargestRepair = 0.0;
  std::vector<std::string> Warnings;
};

void Serialise(StateArchive& stream, SpacetimeOutput& output);

} // namespace waft
