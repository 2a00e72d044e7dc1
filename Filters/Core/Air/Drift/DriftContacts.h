// SPDX-License-Identifier: BSD-3-Clause
// Which objects come too near to each other.
#pragma once

#include "Air/Drift/BodyProblem.h"
#include "Base/Parallel.h"

#include <vector>

namespace waft
{

/// By object in the order of the bodies: others, where they are, that come nearer than the sum of
/// both clearance radii, in the order of frames. Beside a frame at which both are held nearer than
/// that, as much as they are apart there is enough, and more the farther away in time.
std::vector<std::vector<DriftNeighbour>> FindContacts(const std::vector<BodyProblem>& bodies,
                                                      const std::vector<std::vector<Vec3>>& paths,
                                                      double framesPerSecond,
                                                      const ParallelFor& parallel);

} // namespace waft
