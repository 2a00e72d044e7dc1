// SPDX-License-Identifier: BSD-3-Clause
// Conjugate gradients with a multigrid cycle as preconditioner for the pressure.
#pragma once

#include "Base/Parallel.h"
#include "Grid/MultigridKernels.h"

#include <array>
#include <cstdint>
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
/// right-hand sides are made to sum to zero. The cycle is two sweeps of Jacobi down, damped as the
/// Chebyshev polynomial of the upper part of the spectrum asks, aggregation of 2 x 2 x 2 cells with
/// the Galerkin operator halved (which makes up for the stiffness of constant interpolation), and
/// the same two sweeps up.
class PressureSolver
{
public:
  /// weights[axis]: in the padded layout of `cells`, of the face towards the axis's lower end of
  /// each cell; the upper face of the last cell is at its ghost.
  void Build(const PaddedCells& cells, std::array<std::vector<float>, 3> weights,
             const std::array<bool, 3>& periodic);

  const PaddedCells& Cells() const { return this->Levels.front().Cells; }
  const std::vector<float>& Weights(int axis) const { return this->Levels.front().W[axis]; }
  /// b and x are in the padded layout; b becomes the residual, x is the first guess and the answer.
  /// Ends when no |residual| is above the tolerance, or when goOn says false.
  PressureOutcome Solve(std::vector<float>& b, std::vector<float>& x, float tolerance,
                        int maximumIterations, const ParallelFor& parallelFor,
                        const std::function<bool()>& goOn);
  /// Copies the cells at one end of each periodic axis to the ghosts of the other.
  void FillGhosts(std::vector<float>& x) const { this->FillGhosts(this->Levels.front(), x.data()); }

private:
  struct Level
  {
    PaddedCells Cells;
    std::array<std::vector<float>, 3> W;
    std::vector<float> InverseDiagonal;
    std::vector<float> B, X, Other;
    int Ratio[3] = { 1, 1, 1 }; // to the next coarser one
    CellOperator Operator() const
    {
      return { this->W[0].data(), this->W[1].data(), this->W[2].data(),
               this->InverseDiagonal.data() };
    }
  };

  void FinishLevel(Level& level) const;
  bool Coarsen(Level& fine, Level& coarse) const;
  void FindComponents();
  void MakeCompatible(std::vector<float>& b) const;
  void FillGhosts(const Level& level, float* x) const;
  void Smooth(Level& level, const float* b, float* x, bool fromZero,
              const ParallelFor& parallelFor) const;
  void Cycle(std::size_t level, const float* b, float* x, const ParallelFor& parallelFor);
  void CycleOnThreads(std::size_t level, const float* b, float* x, const ParallelFor& parallelFor);
  double Sum(const ParallelFor& parallelFor, const std::function<double(int)>& ofPlane);

  std::array<bool, 3> Periodic{ false, false, false };
  std::vector<Level> Levels;
  std::vector<std::int32_t> Component; // of each padded cell; -1: not singular or no air
  std::vector<std::size_t> ComponentSizes;
  std::vector<float> Z, S, Q;
  std::vector<double> PlaneSums;
};

} // namespace waft
