// SPDX-License-Identifier: BSD-3-Clause
// How a body rolls over on a plane until it stands on three points.
#pragma once

#include "Base/Types.h"

#include <vector>

namespace waft
{

/// Height of the centre, the origin of the points, above a plane that the lowest point touches [m].
double StandingHeight(const std::vector<Vec3>& points, const Quat& orientation, const Vec3& normal);

/// The pose in which a body comes to rest that is put on a plane as it is turned: it rolls down the
/// steepest way over its convex hull, without swing, until the centre is above what carries it. It
/// turns by the least that this takes, so that it keeps its heading. Where it balances on a point
/// or an edge it falls so that its z axis looks up.
Quat RollDown(const std::vector<Vec3>& points, const Quat& orientation, const Vec3& normal);

} // namespace waft
