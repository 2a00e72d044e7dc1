// SPDX-License-Identifier: BSD-3-Clause
#include "Grid/PressureSolver.h"

#include <algorithm>
#include <utility>

namespace waft
{

void PressureSolver::Build(const PaddedCells& cells, std::array<std::vector<float>, 3> weights,
                           const std::array<bool, 3>& periodic)
{
  this->Grids.Build(cells, std::move(weights), periodic);
  const std::size_t size = cells.Size();
  this->Z.assign(size, 0.0f);
  this->S.assign(size, 0.0f);
  this->Q.assign(size, 0.0f);
  this->PlaneSums.assign(cells.N[2], 0.0);
  this->Closed = ClosedAir(
    cells, { this->Weights(0).data(), this->Weights(1).data(), this->Weights(2).data() }, periodic);
}

double PressureSolver::Sum(const ParallelFor& parallelFor,
                           const std::function<double(int)>& ofPlane)
{
  parallelFor(this->PlaneSums.size(),
              [&](std::size_t begin, std::size_t end)
              {
                for (std::size_t k = begin; k < end; ++k)
                {
                  this->PlaneSums[k] = ofPlane(static_cast<int>(k));
                }
              });
  double sum = 0.0;
  for (const double part : this->PlaneSums)
  {
    sum += part;
  }
  return sum;
}

PressureOutcome PressureSolver::Solve(std::vector<float>& b, std::vector<float>& x, float tolerance,
                                      int maximumIterations, const ParallelFor& parallelFor,
                                      const std::function<bool()>& goOn)
{
  const PaddedCells& cells = this->Cells();
  const CellOperator a = this->Grids.Operator();
  // x += alpha s, b -= alpha q; the largest |b|.
  const auto update = [&](float alpha, const std::vector<float>& s)
  {
    this->Sum(parallelFor,
              [&](int k)
              {
                return static_cast<double>(
                  UpdatePlane(cells, alpha, s.data(), this->Q.data(), x.data(), b.data(), k));
              });
    return static_cast<float>(*std::max_element(this->PlaneSums.begin(), this->PlaneSums.end()));
  };
  // q = A s; s . q.
  const auto apply = [&](std::vector<float>& s)
  {
    this->FillGhosts(s);
    return this->Sum(parallelFor,
                     [&](int k) { return ApplyPlane(cells, a, s.data(), this->Q.data(), k); });
  };

  PressureOutcome outcome;
  this->Closed.MakeCompatible(b);
  apply(x);
  std::fill(this->S.begin(), this->S.end(), 0.0f);
  outcome.LargestResidual = update(1.0f, this->S); // b becomes the residual, x stays

  double before = 0.0;
  while (outcome.LargestResidual > tolerance && outcome.Iterations < maximumIterations)
  {
    this->Grids.Cycle(b, this->Z, parallelFor);
    const double rz =
      this->Sum(parallelFor, [&](int k) { return DotPlane(cells, b.data(), this->Z.data(), k); });
    const float beta = before > 0.0 ? static_cast<float>(rz / before) : 0.0f;
    this->Sum(parallelFor,
              [&](int k)
              {
                DirectionPlane(cells, beta, this->Z.data(), this->S.data(), k);
                return 0.0;
              });
    const double curvature = apply(this->S);
    if (!(curvature > 0.0) || !(rz > 0.0))
    {
      break; // rounding is all that is left
    }
    outcome.LargestResidual = update(static_cast<float>(rz / curvature), this->S);
    before = rz;
    ++outcome.Iterations;
    if (!goOn())
    {
      outcome.Stopped = true;
      break;
    }
  }
  return outcome;
}

} // namespace waft
