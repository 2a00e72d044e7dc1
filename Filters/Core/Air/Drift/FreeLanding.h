// SPDX-License-Identifier: BSD-3-Clause
// Where a body that nothing asks for any more comes down.
#pragma once

#include "Air/Drift/BodyProblem.h"
#include "Air/Field/AirSampler.h"

#include <vector>

namespace waft
{

struct FreeLanding
{
  int Frame = -1; // from which it lies there; -1: it does not come down
  Vec3 Place = Vec3::Zero();
};

/// Of a path [m] by frame that keeps its clearance, which leaves it gliding above whatever it sinks
/// to: the first frame from `first` on at which it is about that low above a surface to lie on, and
/// from where it sinks to that surface. On the last of its way it is braked along the surface, as
/// the air is there.
FreeLanding FindFreeLanding(const DriftScene& scene, const MotionObject& body,
                            const AirSampler& air, const std::vector<Vec3>& path, int first);

} // namespace waft
