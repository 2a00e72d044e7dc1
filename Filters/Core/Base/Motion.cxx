// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Motion.h"

namespace waft
{

std::vector<Vec3> CentralVelocities(const std::vector<Vec3>& positions, double step)
{
  const std::size_t n = positions.size();
  std::vector<Vec3> velocities(n, Vec3::Zero());
  if (n == 2)
  {
    velocities[0] = velocities[1] = (positions[1] - positions[0]) / step;
  }
  if (n < 3)
  {
    return velocities;
  }
  for (std::size_t k = 1; k + 1 < n; ++k)
  {
    velocities[k] = (positions[k + 1] - positions[k - 1]) / (2.0 * step);
  }
  velocities[0] = (-3.0 * positions[0] + 4.0 * positions[1] - positions[2]) / (2.0 * step);
  velocities[n - 1] =
    (3.0 * positions[n - 1] - 4.0 * positions[n - 2] + positions[n - 3]) / (2.0 * step);
  return velocities;
}

} // namespace waft
