// SPDX-License-Identifier: BSD-3-Clause
// How the bodies turn in the air along their paths, and where that takes them.
#pragma once

#include "Air/Run/AirState.h"

namespace waft
{

/// The field of an air at a time [s].
FieldSeries FieldAt(const HalfSeries& air, double time);

/// A body's path, with the poses that it flies in where it glides.
Track FlownTrack(const AirBodies& bodies, std::size_t o);

inline std::vector<char> Everybody(const AirBodies& bodies)
{
  return std::vector<char>(bodies.Size(), 1);
}

/// Turns bodies by the air as it is, along their paths, and lets them drift on from there by the
/// slips of those poses, which stay theirs. What an edit leaves as it was keeps its own. Nothing
/// where nothing glides.
Result TurnAndDrift(const AirContext& run, const HalfSeries& air, int iterations,
                    const std::vector<char>& which, AirBodies& bodies);

/// Those that glide keep their poses, and slip by these as the air is now along their paths.
Result SlipAnew(const AirContext& run, const HalfSeries& air, AirBodies& bodies);

/// Turns bodies anew by the air as it is, step by step: what of their paths has been flown in the
/// poses of a step stays, and they drift on from there, so that the air in which they turn is that
/// through which they go. So turns those whose poses are not what the air as it has become makes of
/// them: whose Agreement (Rotation/Agreement.h) is more than 15 degrees in the median, or 45 in the
/// 90th percentile. An edit asks no body that it leaves as it was. Of more than 2048 bodies all
/// keep the poses of their first turning: to ask and to turn them again takes longer than all else
/// that they need.
Result TurnDisagreeing(const AirContext& run, const HalfSeries& air, AirBodies& bodies);

} // namespace waft
