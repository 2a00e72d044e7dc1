// SPDX-License-Identifier: BSD-3-Clause
// A run of the smoke solver as a field for each frame on a lattice of its own, left to itself or
// steered towards a wanted air.
#pragma once

#include "Base/Monitor.h"
#include "Base/Parallel.h"
#include "Grid/SmokeSeries.h"

namespace waft
{

/// What makes an air. Forces and solids are in the time of the frames.
struct AirScene
{
  SmokeOptions Smoke;
  SmokeForces Forces;
  SolidsAtFrame Solids; // empty: none
  bool SolidsMove = false;
  Timeline Time;
  /// Points of the lattice along the volume's sides, whose corners are its own.
  std::array<int, 3> LatticeDimensions{ 32, 32, 32 };
};

/// Steers a simulation: at each frame the air is accelerated by Feed there and towards Target with
/// a rate, at the scale of the lattice.
struct AirSteering
{
  const FieldSeries* Target = nullptr; // m/s; null: left to itself
  const FieldSeries* Feed = nullptr;   // m/s^2, or null
  double Rate = 3.0;                   // 1/s
};

/// An empty series on the scene's lattice.
FieldSeries AirLattice(const AirScene& scene, FieldMeaning meaning);

/// air: the velocity at each frame; steered: the acceleration that was added from each frame on
/// [m/s^2], empty without a target. Two frames of the simulation itself are in memory. Stopped by
/// the monitor, the lists end before the last frame. The same on any number of threads.
Result SimulateAir(const AirScene& scene, const AirSteering& steering, const ParallelFor& parallel,
                   Monitor& monitor, FieldSeries& air, FieldSeries& steered);

/// D u / D t [m/s^2] of a field by central differences, one-sided at the ends of space and time.
FieldSeries MaterialDerivative(const FieldSeries& air, const ParallelFor& parallel);

} // namespace waft
