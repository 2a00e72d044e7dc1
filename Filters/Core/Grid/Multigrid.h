// SPDX-License-Identifier: BSD-3-Clause
// A multigrid cycle on cells: about A^-1 b, for a solver's preconditioner.
#pragma once

#include "Base/Parallel.h"
#include "Grid/MultigridKernels.h"

#include <array>
#include <cstddef>
#include <vector>

namespace waft
{

/// Cells of a grid below which its loops are too short for threads.
constexpr std::size_t FewestCellsForThreads = 20000;

/// The operator A of a grid's faces and coarser ones of it. The cycle is two sweeps of Jacobi down,
/// damped as the Chebyshev polynomial of the upper part of the spectrum asks, aggregation of
/// 2 x 2 x 2 cells with the Galerkin operator halved (which makes up for the stiffness of constant
/// interpolation), and the same two sweeps up.
class Multigrid
{
public:
  /// weights[axis]: in the padded layout of `cells`, of the face towards the axis's lower end of
  /// each cell; the upper face of the last cell is at its ghost.
  void Build(const PaddedCells& cells, std::array<std::vector<float>, 3> weights,
             const std::array<bool, 3>& periodic);

  const PaddedCells& Cells() const { return this->Levels.front().Cells; }
  const std::vector<float>& Weights(int axis) const { return this->Levels.front().W[axis]; }
  /// A of the finest grid.
  CellOperator Operator() const { return this->Levels.front().Operator(); }
  /// One cycle from x = 0; b and x are in the padded layout.
  void Cycle(const std::vector<float>& b, std::vector<float>& x, const ParallelFor& parallelFor)
  {
    this->Cycle(0, b.data(), x.data(), parallelFor);
  }
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
  void FillGhosts(const Level& level, float* x) const;
  void Smooth(Level& level, const float* b, float* x, bool fromZero,
              const ParallelFor& parallelFor) const;
  void Cycle(std::size_t level, const float* b, float* x, const ParallelFor& parallelFor);
  void CycleOnThreads(std::size_t level, const float* b, float* x, const ParallelFor& parallelFor);

  std::array<bool, 3> Periodic{ false, false, false };
  std::vector<Level> Levels; // from the finest
};

} // namespace waft
