// SPDX-License-Identifier: BSD-3-Clause
// What makes a simulation of smoke follow a wanted air.
#pragma once

#include "Base/HalfSeries.h"
#include "Base/Parallel.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace waft
{

/// The fields of a series at a frame and at its two neighbours, of which the ends have one.
class ThreeFrames
{
public:
  using Field = FieldSeries::Field;

  /// Frames in order cost one field each.
  void MoveTo(const HalfSeries& series, std::size_t f);
  /// D u / D t [m/s^2] of a velocity, in the layers k of the lattice from `begin` up to `end`:
  /// central differences, one-sided at the ends of space and time.
  void MaterialDerivative(const HalfSeries& series, std::size_t begin, std::size_t end,
                          Field& derivative) const;
  const Field& Now() const { return this->Fields[1]; }

private:
  std::array<Field, 3> Fields;
  std::size_t Next = static_cast<std::size_t>(-1); // the frame that costs one field
  double Time = 1.0;                               // between the neighbours [s]
};

/// Steers a simulation towards a wanted air at the scale of the lattice: by what the wanted motion
/// asks for beside what drives the air already, and at a rate by what it lacks still.
class AirSteering
{
public:
  using Field = FieldSeries::Field;

  /// wanted: m/s. own: the air as it went without the change, m/s, on the same lattice. Both are to
  /// live as long. rate: 1/s.
  AirSteering(const HalfSeries& wanted, const HalfSeries& own, double rate);
  const HalfSeries& WantedAir() const { return this->Wanted; }
  /// The acceleration from a frame on [m/s^2], where the air moves by `now`. Frames in order. The
  /// same on any number of threads.
  FieldSeries At(int frame, const Field& now, const ParallelFor& parallel);
  /// Of all frames so far.
  HalfSeries TakePushes() { return std::move(this->Pushes); }

private:
  const HalfSeries& Wanted;
  const HalfSeries& Own;
  HalfSeries Pushes;
  double Rate;
  ThreeFrames WantedNow, OwnNow;
};

/// The floor holds the air on it: the layer in which it does is thinner than a cell, and is taken
/// to be as thick as one of the lattice. What lands comes down through it.
template <class Value>
void StopAtFloor(const SeriesLattice& lattice, std::vector<Value>& values)
{
  const auto floor = static_cast<std::ptrdiff_t>(lattice.Dimensions[0]) * lattice.Dimensions[1];
  std::fill_n(values.begin(), floor, Value{});
}

} // namespace waft
