// SPDX-License-Identifier: BSD-3-Clause
// Conjugate gradients with a multigrid cycle as preconditioner for the pressure.
#pragma once

#include "Base/Parallel.h"
#include "Grid/ClosedAir.h"
#include "Grid/Multigrid.h"

#include <array>
#include <functional>
#include <vector>

namespace waft
{

struct PressureOutcome
{
  int Iterations = 0;
  float LargestResidual = 0.0f;
  bool Stopped = false;
};

/// Solves A x = b, with A the operator of the faces' weights: zero weight where no air passes,
/// nothing (x = 0) beyond an open face. Parts of the air without an open face are singular: their
/// right-hand sides are made to sum to zero.
class PressureSolver
{
public:
  /// weights[axis]: in the padded layout of `cells`, of the face towards the axis's lower end of
  /// each cell; the upper face of the last cell is at its ghost.
  void Build(const PaddedCells& cells, std::array<std::vector<float>, 3> weights,
             const std::array<bool, 3>& periodic);

  const PaddedCells& Cells() const { return this->Grids.Cells(); }
  const std::vector<float>& Weights(int axis) const { return this->Grids.Weights(axis); }
  /// b and x are in the padded layout; b becomes the residual, x is the first guess and the answer.
  /// Ends when no |residual| is above the tolerance, or when goOn says false.
  PressureOutcome Solve(std::vector<float>& b, std::vector<float>& x, float tolerance,
                        int maximumIterations, const ParallelFor& parallelFor,
                        const std::function<bool()>& goOn);
  /// Copies the cells at one end of each periodic axis to the ghosts of the other.
  void FillGhosts(std::vector<float>& x) const { this->Grids.FillGhosts(x); }

private:
  double Sum(const ParallelFor& parallelFor, const std::function<double(int)>& ofPlane);

  Multigrid Grids;
  ClosedAir Closed;
  std::vector<float> Z, S, Q;
  std::vector<double> PlaneSums;
};

} // namespace waft
