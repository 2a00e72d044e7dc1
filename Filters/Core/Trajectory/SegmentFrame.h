// SPDX-License-Identifier: BSD-3-Clause
// The frame in which a segment is stored: first sample at the origin, initial horizontal velocity
// along +x, z up.
#pragma once

#include "Base/ForceFields.h"
#include "Base/Types.h"

#include <vector>

namespace waft
{

/// world = Origin + Rotation local; Rotation is a yaw.
struct SegmentFrame
{
  Vec3 Origin = Vec3::Zero();
  Quat Rotation = Quat::Identity();

  Vec3 ToLocal(const Vec3& world) const
  {
    return this->Rotation.conjugate() * (world - this->Origin);
  }
  Vec3 ToWorld(const Vec3& local) const { return this->Origin + this->Rotation * local; }
};

/// The initial velocity is the one-sided difference of second order; a segment that begins straight
/// up or down takes the direction of its horizontal chord, and one without any keeps its yaw.
SegmentFrame FrameOf(const std::vector<Vec3>& positions);

/// Samples as one vector x0 y0 z0 x1 y1 z1 ..., in the frame.
Eigen::VectorXd LocalSamples(const std::vector<Vec3>& positions, const SegmentFrame& frame);

/// A vortex in the frame, its CenterTime counted from `startTime`.
Vortex LocalVortex(const Vortex& vortex, const SegmentFrame& frame, double startTime);

} // namespace waft
