// SPDX-License-Identifier: BSD-3-Clause
#include "Grid/PressureSolver.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

constexpr int CoarsestSweeps = 12;
constexpr std::size_t FewestCellsForThreads = 100000;
/// 1 / (c + r cos(pi / 4)), 1 / (c - r cos(pi / 4)) for the interval [c - r, c + r] = [1/3, 2]: all
/// of the spectrum of D^-1 A (at most 2) that varies within an aggregate.
constexpr float Damping[2] = { 0.5695013f, 1.7318686f };

} // namespace

void PressureSolver::Build(const PaddedCells& cells, std::array<std::vector<float>, 3> weights,
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
  const std::size_t size = cells.Size();
  this->Z.assign(size, 0.0f);
  this->S.assign(size, 0.0f);
  this->Q.assign(size, 0.0f);
  this->PlaneSums.assign(cells.N[2], 0.0);
  this->FindComponents();
}

void PressureSolver::FinishLevel(Level& level) const
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

bool PressureSolver::Coarsen(Level& fine, Level& coarse) const
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

void PressureSolver::FindComponents()
{
  const Level& level = this->Levels[0];
  const PaddedCells& c = level.Cells;
  this->Component.assign(c.Size(), -1);
  this->ComponentSizes.clear();
  std::vector<bool> seen(c.Size(), false);
  struct Place
  {
    int At[3];
  };
  const std::array<std::ptrdiff_t, 3> stride{ 1, c.StrideY, c.StrideZ };
  std::vector<Place> stack;
  std::vector<std::ptrdiff_t> members;
  const auto enter = [&](const Place& place)
  {
    const std::ptrdiff_t p = c.Index(place.At[0], place.At[1], place.At[2]);
    if (!seen[p])
    {
      seen[p] = true;
      stack.push_back(place);
      members.push_back(p);
    }
  };
  for (int k = 0; k < c.N[2]; ++k)
  {
    for (int j = 0; j < c.N[1]; ++j)
    {
      for (int i = 0; i < c.N[0]; ++i)
      {
        const std::ptrdiff_t start = c.Index(i, j, k);
        if (seen[start] || level.InverseDiagonal[start] == 0.0f)
        {
          continue;
        }
        members.clear();
        bool isOpen = false;
        enter({ { i, j, k } });
        while (!stack.empty())
        {
          const Place place = stack.back();
          stack.pop_back();
          const std::ptrdiff_t p = c.Index(place.At[0], place.At[1], place.At[2]);
          for (int axis = 0; axis < 3; ++axis)
          {
            for (int side = -1; side <= 1; side += 2)
            {
              const std::ptrdiff_t face = side < 0 ? p : p + stride[axis];
              if (level.W[axis][face] <= 0.0f)
              {
                continue;
              }
              Place next = place;
              next.At[axis] += side;
              const bool leaves = next.At[axis] < 0 || next.At[axis] >= c.N[axis];
              if (leaves && !this->Periodic[axis])
              {
                isOpen = true;
                continue;
              }
              next.At[axis] = (next.At[axis] + c.N[axis]) % c.N[axis];
              enter(next);
            }
          }
        }
        if (!isOpen)
        {
          for (const std::ptrdiff_t p : members)
          {
            this->Component[p] = static_cast<std::int32_t>(this->ComponentSizes.size());
          }
          this->ComponentSizes.push_back(members.size());
        }
      }
    }
  }
}

void PressureSolver::MakeCompatible(std::vector<float>& b) const
{
  if (this->ComponentSizes.empty())
  {
    return;
  }
  std::vector<double> means(this->ComponentSizes.size(), 0.0);
  for (std::size_t p = 0; p < b.size(); ++p)
  {
    if (this->Component[p] >= 0)
    {
      means[this->Component[p]] += b[p];
    }
  }
  for (std::size_t c = 0; c < means.size(); ++c)
  {
    means[c] /= static_cast<double>(this->ComponentSizes[c]);
  }
  for (std::size_t p = 0; p < b.size(); ++p)
  {
    if (this->Component[p] >= 0)
    {
      b[p] -= static_cast<float>(means[this->Component[p]]);
    }
  }
}

void PressureSolver::FillGhosts(const Level& level, float* x) const
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

void PressureSolver::Smooth(Level& level, const float* b, float* x, bool fromZero,
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

void PressureSolver::Cycle(std::size_t index, const float* b, float* x,
                           const ParallelFor& parallelFor)
{
  Level& level = this->Levels[index];
  const std::size_t cells =
    static_cast<std::size_t>(level.Cells.N[0]) * level.Cells.N[1] * level.Cells.N[2];
  if (cells < FewestCellsForThreads && index > 0)
  {
    // The coarser levels together are less work than the start of a thread.
    const ParallelFor serial = SerialFor();
    this->CycleOnThreads(index, b, x, serial);
    return;
  }
  this->CycleOnThreads(index, b, x, parallelFor);
}

void PressureSolver::CycleOnThreads(std::size_t index, const float* b, float* x,
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
  const Level& level = this->Levels[0];
  const PaddedCells& cells = level.Cells;
  const CellOperator a = level.Operator();
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
  this->MakeCompatible(b);
  apply(x);
  std::fill(this->S.begin(), this->S.end(), 0.0f);
  outcome.LargestResidual = update(1.0f, this->S); // b becomes the residual, x stays

  double before = 0.0;
  while (outcome.LargestResidual > tolerance && outcome.Iterations < maximumIterations)
  {
    this->Cycle(0, b.data(), this->Z.data(), parallelFor);
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
