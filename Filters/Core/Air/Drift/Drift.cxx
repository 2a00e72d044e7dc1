// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift/Drift.h"

#include "Air/Drift/DriftEquations.h"

#include <algorithm>
#include <cmath>

namespace waft
{
std::vector<Vec3> DriftControls(const DriftProblem& problem, const AirSampler& air,
                                const std::vector<Vec3>& path)
{
  const DriftWeights weights;
  const DriftResiduals residuals(problem, air, weights);
  std::vector<Vec3> controls;
  for (int k = 0; k + 1 < static_cast<int>(path.size()); ++k)
  {
    controls.push_back(residuals.Control(path, k, nullptr));
  }
  return controls;
}

double ControlInFlight(const DriftProblem& problem, const AirSampler& air,
                       const std::vector<Vec3>& path)
{
  double sum = 0.0;
  int count = 0;
  const std::vector<Vec3> controls = DriftControls(problem, air, path);
  for (std::size_t k = 0; k < controls.size(); ++k)
  {
    if (problem.Flight[k] >= 1.0)
    {
      sum += controls[k].squaredNorm();
      ++count;
    }
  }
  return count > 0 ? std::sqrt(sum / count) : 0.0;
}

bool IsFreeStep(const DriftProblem& problem, const std::vector<Vec3>& path, int step)
{
  const auto k = static_cast<std::size_t>(step);
  return problem.Flight[k] >= 1.0 &&
         !problem.Ground.Brakes(0.5 * (path[k] + path[k + 1]), step + 0.5);
}

bool IsFreeOfGround(const DriftProblem& problem, const std::vector<Vec3>& path, int step)
{
  const auto k = static_cast<std::size_t>(step);
  return problem.Flight[k] >= 1.0 &&
         problem.Ground.Factor(0.5 * (path[k] + path[k + 1]), step + 0.5) == 1.0;
}

DriftOutcome SolveDrift(const DriftProblem& problem, const AirSampler& air,
                        const DriftWeights& weights, int maximumIterations, std::vector<Vec3>& path)
{
  for (std::size_t f = 0; f < path.size(); ++f)
  {
    path[f] = problem.IsFixed[f] ? problem.Fixed[f] : path[f];
  }
  DriftEquations equations(problem, air, weights);
  DriftOutcome outcome;
  std::vector<Vec3> trial;
  std::vector<double> step;
  DriftDamping damping(problem.Time);
  equations.LookAt(path);
  outcome.Cost = equations.Linearise();
  bool done = false;
  while (!done && outcome.Iterations < maximumIterations)
  {
    ++outcome.Iterations;
    double cost = 1e300;
    double promised = 0.0;
    if (equations.Factor(damping.Value))
    {
      const std::vector<double> descent = equations.Descent();
      step = descent;
      equations.Solve(step);
      promised = PromiseOf(step, descent, damping.Value);
      trial = path;
      MoveBy(step, trial);
      equations.LookAt(trial);
      cost = equations.Cost();
    }
    if (!(cost < outcome.Cost))
    {
      done = !damping.Raise();
      continue;
    }
    done = damping.IsConverged(outcome.Cost, cost);
    damping.Lower(outcome.Cost - cost, promised);
    path = trial;
    outcome.Cost = done ? cost : equations.Linearise();
  }
  return outcome;
}

} // namespace waft
