// SPDX-License-Identifier: BSD-3-Clause
// How a body is turned as its path begins, where nobody says.
#pragma once

#include "Base/Random.h"
#include "Rotation/Flight.h"

namespace waft
{

/// That of a body that hangs by its longest side, its x axis: turned about the vertical by chance.
Quat HangingPose(Random& random);

/// The state after two seconds of flight, from a pose by chance and no turning, in the air of the
/// path's frame `first` and within its limit of turning there: no two bodies begin in step, and
/// none has to find its way of flying first.
FlightState StateInFlight(const FlightBody& body, const FlightPath& path, int first, Random random);

} // namespace waft
