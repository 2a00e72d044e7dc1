// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Motion.h"

#include <algorithm>

namespace waft
{

std::vector<Vec3> CentralDifferences(const std::vector<Vec3>& samples, double step, std::size_t a,
                                     std::size_t end)
{
  const std::size_t n = std::min(samples.size(), end);
  std::vector<Vec3> differences(samples.size(), Vec3::Zero());
  if (n == a + 2)
  {
    differences[a] = differences[a + 1] = (samples[a + 1] - samples[a]) / step;
  }
  if (n < a + 3)
  {
    return differences;
  }
  for (std::size_t k = a + 1; k + 1 < n; ++k)
  {
    differences[k] = (samples[k + 1] - samples[k - 1]) / (2.0 * step);
  }
  differences[a] = (-3.0 * samples[a] + 4.0 * samples[a + 1] - samples[a + 2]) / (2.0 * step);
  differences[n - 1] =
    (3.0 * samples[n - 1] - 4.0 * samples[n - 2] + samples[n - 3]) / (2.0 * step);
  return differences;
}

std::vector<Vec3> CentralVelocities(const Track& track, double step)
{
  return CentralDifferences(track.Positions, step, static_cast<std::size_t>(track.FirstPresent),
                            track.EndPresent());
}

} // namespace waft
