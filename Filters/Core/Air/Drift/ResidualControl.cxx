// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift/ResidualControl.h"

namespace waft
{

ResidualControl ResidualControlOf(const BodyProblem& body, const AirSampler& air,
                                  const std::vector<Vec3>& path)
{
  const DriftProblem problem = body.In(air);
  const std::vector<Vec3> controls = DriftControls(problem, air, path);
  ResidualControl residual;
  for (std::size_t k = 0; k < controls.size(); ++k)
  {
    if (problem.Flight[k] >= 1.0)
    {
      residual.Control += controls[k].squaredNorm();
      residual.Flow +=
        air.Between(static_cast<int>(k), 0.5 * (path[k] + path[k + 1])).squaredNorm();
      ++residual.Steps;
    }
  }
  return residual;
}

} // namespace waft
