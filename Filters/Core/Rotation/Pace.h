// SPDX-License-Identifier: BSD-3-Clause
// How fast a body may turn so that an eye can follow it.
#pragma once

#include "Base/Motion.h"
#include "Rotation/Flight.h"

namespace waft
{

/// The most that a body turns from a frame to the next [rad]: MaximumTurn [degrees], or, where that
/// is 0, what is seldom come to at the pace of PaceOf.
double MostTurn(double maximumTurn, const Timeline& time);

/// Seconds of a body's turning in a second: 1, or less for one so narrow that its steady tumbling
/// is faster than an eye can follow. Plates tumble with tips nearly as fast as they fly (Iversen
/// 1979), so that their rate goes as 1 / width; a narrow one is turned as one of the same form is
/// that is as much larger. speed: at which it settles [m/s].
double PaceOf(const FlightBody& body, const ShellProperties& properties, double speed);

/// Of the seconds of its turning at a pace: by what gusts turn a body faster than its steady
/// tumbling goes soon, so that few frames show it.
TurningEase EaseAt(double pace);

} // namespace waft
