// SPDX-License-Identifier: BSD-3-Clause
// A run of the smoke solver as a field for each frame on a lattice of its own, left to itself or
// steered towards a wanted air.
#pragma once

#include "Air/Field/AirSteering.h"
#include "Base/HalfSeries.h"
#include "Base/Monitor.h"
#include "Base/Parallel.h"
#include "Grid/SmokeSeries.h"
#include "Grid/SmokeSolver.h"

#include <array>
#include <utility>
#include <vector>

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

/// An empty series on the scene's lattice.
HalfSeries AirLattice(const AirScene& scene, FieldMeaning meaning);

/// Where the solids are at a frame; nothing where there are none, or they do not move after the
/// first.
Result PlaceSolids(const AirScene& scene, int frame, SmokeSolver& solver);
/// The velocities in a solver's cells, on the scene's lattice, behind what the series has.
void AppendAir(const AirScene& scene, const SmokeFrame& cells, double time,
               const ParallelFor& parallel, HalfSeries& air);

/// A series at the points of another lattice, linear between its own.
HalfSeries OnLattice(HalfSeries series, const SeriesLattice& lattice, const ParallelFor& parallel);

/// air: the velocity at each frame. steering: null: left to itself; else the air begins with the
/// wanted velocity of the first frame. begun: the state before that frame, from which it is warmed
/// up; null: it begins at rest.
/// Two frames of the simulation itself are in memory. Stopped by the monitor, the list ends before
/// the last frame. The same on any number of threads.
Result SimulateAir(const AirScene& scene, AirSteering* steering, const ParallelFor& parallel,
                   Monitor& monitor, HalfSeries& air, const SmokeState* begun = nullptr);

} // namespace waft
