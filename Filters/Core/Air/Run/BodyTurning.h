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

/// TurnAndDrift for those whose poses are not what the air as it has become makes of them: whose
/// mean Agreement (Rotation/Agreement.h) is beyond these degrees. An edit asks no body that it
/// leaves as it was.
Result TurnDisagreeing(const AirContext& run, const HalfSeries& air, double degrees,
                       AirBodies& bodies);
/// The same in an air that becomes no other: who would need more control for it, and more than an
/// air may leave (EnoughControl), keeps its poses and its path.
Result TurnAstray(const AirContext& run, const HalfSeries& air, double degrees, AirBodies& bodies);

} // namespace waft
