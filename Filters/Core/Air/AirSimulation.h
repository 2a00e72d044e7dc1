// SPDX-License-Identifier: BSD-3-Clause
// A run of the smoke solver as a field for each frame on a lattice of its own, left to itself or
// steered towards a wanted air.
#pragma once

#include "Base/HalfSeries.h"
#include "Base/Monitor.h"
#include "Base/Parallel.h"
#include "Grid/SmokeSeries.h"

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

/// Steers a simulation towards a wanted air at the scale of the lattice: by what the wanted motion
/// asks for beside what drives the air already, and at a rate by what it lacks still.
class AirSteering
{
public:
  using Field = FieldSeries::Field;

  /// wanted: m/s, is the caller's until the last frame. own: the air as it went without the change,
  /// m/s; push: what steered it then, m/s^2, or empty. Both are let go of as the frames pass. rate:
  /// 1/s.
  AirSteering(const HalfSeries& wanted, HalfSeries own, HalfSeries push, double rate);
  /// What the air of the first frame, which moves by `now`, lacks of the wanted one [m/s].
  FieldSeries Lacking(const Field& now) const;
  /// The acceleration from a frame on [m/s^2], where the air moves by `now`. Frames in order.
  FieldSeries At(int frame, const Field& now);
  /// Of all frames so far.
  HalfSeries TakePushes() { return std::move(this->Pushes); }

private:
  const HalfSeries& Wanted;
  HalfSeries Own, Pushes;
  double Rate;
};

/// An empty series on the scene's lattice.
HalfSeries AirLattice(const AirScene& scene, FieldMeaning meaning);

/// The floor holds the air on it: the layer in which it does is thinner than a cell, and is taken
/// to be as thick as one of the lattice. What lands comes down through it.
void StopAtFloor(const SeriesLattice& lattice, AirSteering::Field& values);

/// air: the velocity at each frame. steering: null: left to itself; else the air has the wanted
/// velocity from its first frame on, to which it would have to be pushed otherwise. begun: the
/// state of the first frame before that: gone on from where it is given, left where it is empty.
/// Two frames of the simulation itself are in memory. Stopped by the monitor, the list ends before
/// the last frame. The same on any number of threads.
Result SimulateAir(const AirScene& scene, AirSteering* steering, const ParallelFor& parallel,
                   Monitor& monitor, HalfSeries& air, SmokeState* begun = nullptr);

/// D u / D t [m/s^2] of frame f by central differences, one-sided at the ends of space and time.
AirSteering::Field MaterialDerivative(const HalfSeries& air, std::size_t f);

} // namespace waft
