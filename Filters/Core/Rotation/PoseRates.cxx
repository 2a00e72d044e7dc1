// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/PoseRates.h"

#include "Rotation/RigidBody.h"

#include <cmath>

namespace waft
{
namespace
{
/// The rotation vector to the next frame, on the branch nearest to the angular velocity `own`.
Vec3 TurnToNext(const std::vector<Quat>& poses, int frame, double step, const Vec3& own)
{
  const Vec3 turn = LogMap(poses[frame + 1] * poses[frame].conjugate());
  const double angle = turn.norm();
  if (angle < 1e-9)
  {
    return turn;
  }
  const double full = 2.0 * std::acos(-1.0);
  const double expected = own.dot(turn) / angle * step;
  return turn * (1.0 + std::round((expected - angle) / full) * full / angle);
}
} // namespace

void SetRatesWhereTurned(const std::vector<unsigned char>& changed, double step, PoseTrack& poses)
{
  const int last = static_cast<int>(changed.size()) - 1;
  const std::vector<Vec3> own = poses.AngularVelocities;
  for (int k = 0; k <= last; ++k)
  {
    if (changed[k] == 0 || last == 0)
    {
      continue;
    }
    const int before = std::max(k - 1, 0);
    const int after = std::min(k + 1, last);
    Vec3 turn = Vec3::Zero();
    for (int i = before; i < after; ++i)
    {
      turn += TurnToNext(poses.Orientations, i, step, own[k]);
    }
    poses.AngularVelocities[k] = turn / ((after - before) * step);
  }
}

void JoinSigns(std::vector<Quat>& poses)
{
  for (std::size_t k = 1; k < poses.size(); ++k)
  {
    if (poses[k].dot(poses[k - 1]) < 0.0)
    {
      poses[k].coeffs() = -poses[k].coeffs();
    }
  }
}

} // namespace waft
