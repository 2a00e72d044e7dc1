// SPDX-License-Identifier: BSD-3-Clause
// Samples for the fit out of tracks, and what fitted vortices explain of them.
#pragma once

#include "Base/ForceFields.h"
#include "Base/Motion.h"
#include "Base/Result.h"
#include "Base/Types.h"
#include "Vortex/VortexFit.h"

#include <vector>

namespace waft
{

/// One sample per frame of every track, in their order: Forces [m/s^2], less WindAccelerations with
/// subtractWind where a track has them. A sample is claimed by the vortex of its annotation when
/// ForceType says vortex. Samples with a Force of exactly zero have no weight: nothing is known
/// there (an object at rest). Error: a track without Forces.
Result SamplesFromTracks(const std::vector<Track>& tracks, const Timeline& time, bool subtractWind,
                         std::vector<VortexSample>& samples);

/// Takes in place of Forces what the air about each track does: the rate at which its AirVelocities
/// change along the path [m/s^2], by central differences, one-sided at both ends. What was put into
/// the air is no part of that; pressure is. WindAccelerations and annotations are dropped. Error: a
/// track without AirVelocities.
Result TakeAirAccelerations(const Timeline& time, std::vector<Track>& tracks);

/// Sum of the vortices' accelerations at the positions of a track [m/s^2], one a frame.
std::vector<Vec3> VortexForces(const Track& track, const std::vector<Vortex>& vortices,
                               const Timeline& time);

} // namespace waft
