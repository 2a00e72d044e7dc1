// SPDX-License-Identifier: BSD-3-Clause
#include "Grid/Multigrid.h"

#include <utility>

namespace waft
{
namespace
{

constexpr int CoarsestSweeps = 12;
/// 1 / (c + r cos(pi / 4)), 1 / (c - r cos(pi / 4)) for the interval [c - r, c + r] = [1/3, 2]: all
/// of the spectrum of D^-1 A (at most 2) that varies within an aggregate.
constexpr float Damping[2] = { 0.5695013f, 1.7318686f };

} // namespace

void Multigrid::Build(const PaddedCells& cells, std::array<std::vector<float>, 3> weights,
                      const std::array<bool, 3>& periodic)
{
  this->Periodic = periodic;
  this->Levels.clear();
  this->Levels.emplace_back();
  this->Levels[0].Cells = cells;
  this->Levels[0].W = std::move(weights);
  this->FinishLevel(this->Levels[0]);
  for (Level coarse; this->Coarsen(this->Levels.back(), coarse); coarse = Level())
  {
    this->Levels.push_back(std::move(coarse));
  }
}

void Multigrid::FinishLevel(Level& level) const
{
  const PaddedCells& c = level.Cells;
  level.InverseDiagonal.assign(c.Size(), 0.0f);
  level.B.assign(c.Size(), 0.0f);
  level.X.assign(c.Size(), 0.0f);
  level.Other.assign(c.Size(), 0.0f);
  for (int k = 0; k < c.N[2]; ++k)
  {
    for (int j = 0; j < c.N[1]; ++j)
    {
      for (int i = 0; i < c.N[0]; ++i)
      {
        const std::ptrdiff_t p = c.Index(i, j, k);
        const float diagonal =
          ((level.W[0][p] + level.W[0][p + 1]) + (level.W[1][p] + level.W[1][p + c.StrideY])) +
          (level.W[2][p] + level.W[2][p + c.StrideZ]);
        level.InverseDiagonal[p] = diagonal > 0.0f ? 1.0f / diagonal : 0.0f;
      }
    }
  }
}

bool Multigrid::Coarsen(Level& fine, Level& coarse) const
{
  std::array<int, 3> n = fine.Cells.N;
  bool smaller = false;
  for (int axis = 0; axis < 3; ++axis)
  {
    // A periodic axis must stay whole; others end with a half-empty aggregate.
    const bool halve = n[axis] > 2 && !(this->Periodic[axis] && n[axis] % 2 != 0);
    fine.Ratio[axis] = halve ? 2 : 1;
    n[axis] = halve ? (n[axis] + 1) / 2 : n[axis];
    smaller = smaller || halve;
  }
  if (!smaller)
  {
    return false;
  }
  coarse.Cells = PaddedCells(n);
  for (int axis = 0; axis < 3; ++axis)
  {
    std::vector<double> sums(coarse.Cells.Size(), 0.0);
    std::array<int, 3> end = fine.Cells.N;
    ++end[axis];
    for (int k = 0; k < end[2]; ++k)
    {
      for (int j = 0; j < end[1]; ++j)
      {
        for (int i = 0; i < end[0]; ++i)
        {
          std::array<int, 3> at{ i, j, k };
          const bool isLast = at[axis] == fine.Cells.N[axis];
          if (!isLast && at[axis] % fine.Ratio[axis] != 0)
          {
            continue; // inside an aggregate
          }
          std::array<int, 3> to{ i / fine.Ratio[0], j / fine.Ratio[1], k / fine.Ratio[2] };
          to[axis] = isLast ? n[axis] : to[axis];
          // A face between aggregates that are one cell thick along its axis needs no halving.
          const double scale = fine.Ratio[axis] == 2 ? 0.5 : 1.0;
          sums[coarse.Cells.Index(to[0], to[1], to[2])] +=
            scale * fine.W[axis][fine.Cells.Index(i, j, k)];
        }
      }
    }
    coarse.W[axis].assign(sums.begin(), sums.end());
  }
  this->FinishLevel(coarse);
  return true;
}

void Multigrid::FillGhosts(const Level& level, float* x) const
{
  const PaddedCells& c = level.Cells;
  const std::array<std::ptrdiff_t, 3> stride{ 1, c.StrideY, c.StrideZ };
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!this->Periodic[axis])
    {
      continue;
    }
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    const std::ptrdiff_t period = c.N[axis] * stride[axis];
    for (int b = 0; b < c.N[v]; ++b)
    {
      for (int a = 0; a < c.N[u]; ++a)
      {
        const std::ptrdiff_t first = c.Index(0, 0, 0) + a * stride[u] + b * stride[v];
        x[first - stride[axis]] = x[first - stride[axis] + period];
        x[first + period] = x[first];
      }
    }
  }
}

void Multigrid::Smooth(Level& level, const float* b, float* x, bool fromZero,
                       const ParallelFor& parallelFor) const
{
  const CellOperator a = level.Operator();
  float* other = level.Other.data();
  if (!fromZero)
  {
    this->FillGhosts(level, x);
  }
  const auto forPlanes = [&](const auto& body)
  {
    parallelFor(level.Cells.N[2],
                [&](std::size_t begin, std::size_t end)
                {
                  for (std::size_t k = begin; k < end; ++k)
                  {
                    body(static_cast<int>(k));
                  }
                });
  };
  forPlanes(
    [&](int k)
    {
      if (fromZero)
      {
        StartPlane(level.Cells, a, b, Damping[0], other, k);
      }
      else
      {
        RelaxPlane(level.Cells, a, b, Damping[0], x, other, k);
      }
    });
  this->FillGhosts(level, other);
  forPlanes([&](int k) { RelaxPlane(level.Cells, a, b, Damping[1], other, x, k); });
}

void Multigrid::Cycle(std::size_t index, const float* b, float* x, const ParallelFor& parallelFor)
{
  Level& level = this->Levels[index];
  const std::size_t cells =
    static_cast<std::size_t>(level.Cells.N[0]) * level.Cells.N[1] * level.Cells.N[2];
  if (cells < FewestCellsForThreads && index > 0)
  {
    // Threads hear later of a loop over a coarser level than it takes.
    const ParallelFor serial = SerialFor();
    this->CycleOnThreads(index, b, x, serial);
    return;
  }
  this->CycleOnThreads(index, b, x, parallelFor);
}

void Multigrid::CycleOnThreads(std::size_t index, const float* b, float* x,
                               const ParallelFor& parallelFor)
{
  Level& level = this->Levels[index];
  this->Smooth(level, b, x, true, parallelFor);
  if (index + 1 == this->Levels.size())
  {
    for (int sweep = 1; sweep < CoarsestSweeps; ++sweep)
    {
      this->Smooth(level, b, x, false, parallelFor);
    }
    return;
  }
  this->FillGhosts(level, x);
  Level& coarse = this->Levels[index + 1];
  const CellOperator a = level.Operator();
  parallelFor(coarse.Cells.N[2],
              [&](std::size_t begin, std::size_t end)
              {
                std::vector<float> row(level.Cells.StrideY + 2);
                for (std::size_t k = begin; k < end; ++k)
                {
                  RestrictResidualPlane(level.Cells, a, b, x, coarse.Cells, level.Ratio,
                                        coarse.B.data(), row.data(), static_cast<int>(k));
                }
              });
  this->Cycle(index + 1, coarse.B.data(), coarse.X.data(), parallelFor);
  parallelFor(level.Cells.N[2],
              [&](std::size_t begin, std::size_t end)
              {
                for (std::size_t k = begin; k < end; ++k)
                {
                  ProlongatePlane(level.Cells, coarse.Cells, level.Ratio, coarse.X.data(), x,
                                  static_cast<int>(k));
                }
              });
  this->Smooth(level, b, x, false, parallelFor);
}

} // namespace waft
