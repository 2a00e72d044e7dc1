// SPDX-License-Identifier: BSD-3-Clause
#include "Trajectory/SegmentFrame.h"

#include <cmath>

namespace waft
{

SegmentFrame FrameOf(const std::vector<Vec3>& positions)
{
  SegmentFrame frame;
  frame.Origin = positions.front();
  if (positions.size() < 3)
  {
    return frame;
  }
  const Vec3 velocity = -1.5 * positions[0] + 2.0 * positions[1] - 0.5 * positions[2];
  Vec3 ahead = velocity;
  if (std::hypot(velocity.x(), velocity.y()) <= 1e-6 * velocity.norm())
  {
    ahead = positions.back() - positions.front();
  }
  if (std::hypot(ahead.x(), ahead.y()) > 1e-9)
  {
    frame.Rotation = Quat(Eigen::AngleAxisd(std::atan2(ahead.y(), ahead.x()), Vec3::UnitZ()));
  }
  return frame;
}

Eigen::VectorXd LocalSamples(const std::vector<Vec3>& positions, const SegmentFrame& frame)
{
  Eigen::VectorXd samples(3 * static_cast<Eigen::Index>(positions.size()));
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    samples.segment<3>(3 * static_cast<Eigen::Index>(i)) = frame.ToLocal(positions[i]);
  }
  return samples;
}

Vortex LocalVortex(const Vortex& vortex, const SegmentFrame& frame, double startTime)
{
  Vortex local = vortex;
  local.P1 = frame.ToLocal(vortex.P1);
  local.P2 = frame.ToLocal(vortex.P2);
  local.CenterTime = vortex.CenterTime - startTime;
  return local;
}

} // namespace waft
