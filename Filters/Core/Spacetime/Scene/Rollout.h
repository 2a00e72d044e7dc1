// SPDX-License-Identifier: BSD-3-Clause
// The motion run forward, frame after frame, by nothing but what the model gives.
#pragma once

#include "Base/Monitor.h"
#include "Spacetime/Energy/SpacetimeObjective.h"

namespace waft
{

/// Velocity of a body in the step from level frame j, at x with velocity v there [dx / frame].
/// terms: of that frame; pull: an acceleration of its own [dx / frame^2].
Vec3 NextVelocity(const SpacetimeModel& model, const TimeLevel& level, FrameTerms& terms,
                  std::size_t j, std::size_t body, const Vec3& x, const Vec3& v, const Vec3& pull);
/// Fills its rows of the next frame; it is kept in the box of the gas.
void MoveBody(const SpacetimeModel& model, std::size_t body, double step, const Vec3& x,
              const Vec3& velocity, float* next);

/// How far a solution is a motion of the model: gas and objects let go from it at frames 30, 90 and
/// 150, as far as they are there, and run forward for a second; rms of what their velocities are
/// off then, over rms of the velocities. Negative: no time for it.
struct ReplayError
{
  double Objects = -1.0, Gas = -1.0; // objects in free flight all the while
};

/// state: of all frames; second: in frames. Stopped by the monitor: as if there were no time for
/// it.
ReplayError MeasureReplay(SpacetimeObjective& objective, const StateVector& state, int second,
                          Monitor& monitor);

} // namespace waft
