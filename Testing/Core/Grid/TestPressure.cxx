// SPDX-License-Identifier: BSD-3-Clause
#include "Base/Random.h"
#include "Grid/PressureSolver.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace waft;

namespace
{

using Weights = std::array<std::vector<float>, 3>;

// All faces open, those at the ends by `ends`.
Weights MakeWeights(const PaddedCells& cells, float ends)
{
  Weights weights;
  for (int axis = 0; axis < 3; ++axis)
  {
    weights[axis].assign(cells.Size(), 0.0f);
    std::array<int, 3> count = cells.N;
    ++count[axis];
    for (int k = 0; k < count[2]; ++k)
    {
      for (int j = 0; j < count[1]; ++j)
      {
        for (int i = 0; i < count[0]; ++i)
        {
          const int at = axis == 0 ? i : axis == 1 ? j : k;
          const bool isEnd = at == 0 || at == cells.N[axis];
          weights[axis][cells.Index(i, j, k)] = isEnd ? ends : 1.0f;
        }
      }
    }
  }
  return weights;
}

std::vector<float> RandomField(const PaddedCells& cells, std::uint64_t seed)
{
  Random random(seed);
  std::vector<float> field(cells.Size(), 0.0f);
  for (int k = 0; k < cells.N[2]; ++k)
  {
    for (int j = 0; j < cells.N[1]; ++j)
    {
      for (int i = 0; i < cells.N[0]; ++i)
      {
        field[cells.Index(i, j, k)] = static_cast<float>(random.Uniform(-1.0, 1.0));
      }
    }
  }
  return field;
}

// b - A x in double, by the definition of the operator.
double LargestResidual(const PaddedCells& cells, const Weights& w, const std::vector<float>& b,
                       const std::vector<float>& x)
{
  const std::array<std::ptrdiff_t, 3> stride{ 1, cells.StrideY, cells.StrideZ };
  double largest = 0.0;
  for (int k = 0; k < cells.N[2]; ++k)
  {
    for (int j = 0; j < cells.N[1]; ++j)
    {
      for (int i = 0; i < cells.N[0]; ++i)
      {
        const std::ptrdiff_t p = cells.Index(i, j, k);
        double sum = b[p];
        for (int axis = 0; axis < 3; ++axis)
        {
          const std::ptrdiff_t s = stride[axis];
          sum -= w[axis][p] * (static_cast<double>(x[p]) - x[p - s]);
          sum -= w[axis][p + s] * (static_cast<double>(x[p]) - x[p + s]);
        }
        largest = std::max(largest, std::abs(sum));
      }
    }
  }
  return largest;
}

bool Always()
{
  return true;
}

} // namespace

TEST(PressureSolver, SolvesAnySizeWithOpenEnds)
{
  for (const std::array<int, 3>& n :
       { std::array<int, 3>{ 32, 32, 32 }, { 17, 30, 5 }, { 64, 8, 23 }, { 4, 4, 4 } })
  {
    const PaddedCells cells(n);
    const Weights weights = MakeWeights(cells, 1.0f);
    PressureSolver solver;
    solver.Build(cells, weights, { false, false, false });
    const std::vector<float> b = RandomField(cells, 1);
    std::vector<float> residual = b;
    std::vector<float> x(cells.Size(), 0.0f);
    const PressureOutcome outcome = solver.Solve(residual, x, 1e-4f, 100, SerialFor(), Always);
    EXPECT_LE(outcome.LargestResidual, 1e-4f);
    EXPECT_LE(outcome.Iterations, 25) << n[0] << " " << n[1] << " " << n[2];
    EXPECT_LE(LargestResidual(cells, weights, b, x), 2e-4);
  }
}

TEST(PressureSolver, IterationsHardlyGrowWithResolution)
{
  int iterations[2];
  for (int level = 0; level < 2; ++level)
  {
    const int n = level == 0 ? 16 : 64;
    const PaddedCells cells({ n, n, n });
    PressureSolver solver;
    solver.Build(cells, MakeWeights(cells, 0.0f), { false, false, false });
    std::vector<float> b = RandomField(cells, 2);
    std::vector<float> x(cells.Size(), 0.0f);
    iterations[level] = solver.Solve(b, x, 1e-4f, 100, SerialFor(), Always).Iterations;
  }
  EXPECT_LE(iterations[1], iterations[0] + 8);
}

TEST(PressureSolver, MakesSealedRoomsCompatible)
{
  // A wall across the middle of a closed box: two rooms, each with a mean that no pressure can
  // remove.
  const PaddedCells cells({ 16, 12, 10 });
  Weights weights = MakeWeights(cells, 0.0f);
  for (int k = 0; k < 10; ++k)
  {
    for (int j = 0; j < 12; ++j)
    {
      weights[0][cells.Index(7, j, k)] = 0.0f;
    }
  }
  PressureSolver solver;
  solver.Build(cells, weights, { false, false, false });
  std::vector<float> b = RandomField(cells, 3);
  std::vector<double> sums(2, 0.0);
  for (int k = 0; k < 10; ++k)
  {
    for (int j = 0; j < 12; ++j)
    {
      for (int i = 0; i < 16; ++i)
      {
        b[cells.Index(i, j, k)] += i < 7 ? 1.0f : -0.5f;
      }
    }
  }
  std::vector<float> x(cells.Size(), 0.0f);
  const PressureOutcome outcome = solver.Solve(b, x, 1e-4f, 100, SerialFor(), Always);
  EXPECT_LE(outcome.LargestResidual, 1e-4f);
  EXPECT_LE(outcome.Iterations, 25);
}

TEST(PressureSolver, PassesOverCellsThatAreShutIn)
{
  const PaddedCells cells({ 12, 12, 12 });
  Weights weights = MakeWeights(cells, 0.0f);
  const std::ptrdiff_t shut = cells.Index(5, 6, 4);
  const std::array<std::ptrdiff_t, 3> stride{ 1, cells.StrideY, cells.StrideZ };
  for (int axis = 0; axis < 3; ++axis)
  {
    weights[axis][shut] = weights[axis][shut + stride[axis]] = 0.0f;
  }
  PressureSolver solver;
  solver.Build(cells, weights, { false, false, false });
  std::vector<float> b = RandomField(cells, 3);
  b[shut] = 3.0f; // as a solid's faces may have it that closed about it while it moved
  std::vector<float> x(cells.Size(), 0.0f);
  const PressureOutcome outcome = solver.Solve(b, x, 1e-4f, 100, SerialFor(), Always);
  EXPECT_LE(outcome.LargestResidual, 1e-4f);
  EXPECT_LE(outcome.Iterations, 25);
}

TEST(PressureSolver, IsTheSameWithTwoThreads)
{
  const PaddedCells cells({ 40, 24, 37 });
  std::vector<float> answers[2];
  for (int threads = 1; threads <= 2; ++threads)
  {
    PressureSolver solver;
    solver.Build(cells, MakeWeights(cells, 1.0f), { false, false, false });
    std::vector<float> b = RandomField(cells, 4);
    answers[threads - 1].assign(cells.Size(), 0.0f);
    solver.Solve(b, answers[threads - 1], 1e-4f, 100, ThreadedFor(threads), Always);
  }
  EXPECT_EQ(answers[0], answers[1]);
}
