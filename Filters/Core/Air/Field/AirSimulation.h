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
/// The solver's air as it is, on the scene's lattice, behind what the series has.
void AppendAir(const AirScene& scene, const SmokeSolver& solver, const ParallelFor& parallel,
               HalfSeries& air);

/// air: the velocity at each frame. steering: null: left to itself; else the air has the wanted
/// velocity from its first frame on, to which it would have to be pushed otherwise. begun: the
/// state of the first frame before that: left where it is empty, gone on from where it is given; of
/// frame -1 it is warmed up first, and left.
/// Two frames of the simulation itself are in memory. Stopped by the monitor, the list ends before
/// the last frame. The same on any number of threads.
Result SimulateAir(const AirScene& scene, AirSteering* steering, const ParallelFor& parallel,
                   Monitor& monitor, HalfSeries& air, SmokeState* begun = nullptr);

} // namespace waft
