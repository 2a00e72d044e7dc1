// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift/PrivateHand.h"

namespace waft
{

PrivateHand HandOf(const Drifter& drifter, const AirSampler& air, const std::vector<Vec3>& path)
{
  const DriftProblem problem = drifter.Problem(air);
  const std::vector<Vec3> controls = DriftControls(problem, air, path);
  PrivateHand hand;
  for (std::size_t k = 0; k < controls.size(); ++k)
  {
    if (problem.Flight[k] >= 1.0)
    {
      hand.Control += controls[k].squaredNorm();
      hand.Flow += air.Between(static_cast<int>(k), 0.5 * (path[k] + path[k + 1])).squaredNorm();
      ++hand.Steps;
    }
  }
  return hand;
}

} // namespace waft
