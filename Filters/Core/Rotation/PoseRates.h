// SPDX-License-Identifier: BSD-3-Clause
// Poses that were turned after the flight: their angular velocities, and the signs of quaternions.
#pragma once

#include "Base/Pose.h"

#include <vector>

namespace waft
{

/// Where poses were changed, the angular velocity becomes that of the poses as they are: the mean
/// of the turns from the frame before and to the next, each on the branch nearest to the one that
/// stands there. step: s, between frames.
void SetRatesWhereTurned(const std::vector<unsigned char>& changed, double step, PoseTrack& poses);

/// Of q and -q, which are one pose, each frame gets the one nearer to the frame before.
void JoinSigns(std::vector<Quat>& poses);

} // namespace waft
