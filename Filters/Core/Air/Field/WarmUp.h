// SPDX-License-Identifier: BSD-3-Clause
// How an air that is stirred comes from rest to where it goes on as it is.
#pragma once

#include "Air/Field/AirSimulation.h"

#include <functional>
#include <string>

namespace waft
{

/// Times are those of a clock that begins with the air at rest.
struct WarmUp
{
  int Frames = 0;        // from rest to the shot's first
  int Turnover = 0;      // frames that the last turnover takes
  int Stride = 1;        // frames that a step of the coarse air takes
  bool IsSteady = false; // false: it was given up
  HalfSeries Recent;     // the coarse air of the last two turnovers before the shot, by steps

  /// "14.9 s, 3.2 turnovers".
  std::string Text(double framesPerSecond) const;
};

/// The air is steady when the means over a turnover (the volume's width over the air's rms
/// velocity) of its velocity and its vorticity are within 10 % of those over the turnover before;
/// it is given up after four. scene: coarse; of its forces the field of wind alone is looked at.
/// forces: those that are felt up to a time [s].
Result FindWarmUp(AirScene scene, const std::function<SmokeForces(double until)>& forces,
                  const ParallelFor& parallel, Monitor& monitor, WarmUp& found);

/// For SimulateAir of a scene on whatever grid: the state from which it warms up for the last
/// turnover. Sets the scene's WarmUpSeconds.
Result BeginWarmUp(const WarmUp& warmUp, AirScene& scene, SmokeState& begun);

} // namespace waft
