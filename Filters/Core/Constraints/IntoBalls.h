// SPDX-License-Identifier: BSD-3-Clause
// How a path comes into the balls of its rows.
#pragma once

#include "Constraints/LinearCluster.h"

#include <functional>
#include <vector>

namespace waft
{

/// Brings the path (one place a frame, `step` seconds apart [m]) into the balls of the frames that
/// do not stay, each from outside to its nearest point. The frames around go along, less and less,
/// at up to 5 m/s^2 and not beyond the next frame that stays or has a ball: a frame moved alone
/// would be a jump there and back. keepInside: what may be moved a little afterwards (the path).
/// False: it was in all of them.
bool MoveIntoBalls(const std::vector<PositionBall>& balls,
                   const std::function<bool(std::size_t frame)>& stays, double step,
                   const std::function<void(std::vector<Vec3>& path)>& keepInside,
                   std::vector<Vec3>& path);

/// Its nearest point to x: x itself within it.
Vec3 NearestOf(const PositionBall& ball, const Vec3& x);

} // namespace waft
