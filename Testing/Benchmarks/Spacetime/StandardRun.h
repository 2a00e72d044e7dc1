// SPDX-License-Identifier: BSD-3-Clause
// The standard problem solved as the optimiser solves: gas set in motion, then levels of time from
// coarse to fine; E is measured at all frames on the way, off the clock.
#pragma once

#include "Base/Parallel.h"
#include "StandardProblem.h"

#include <vector>

namespace waft
{

/// One level: frames `Stride` apart, so many iterations.
struct StandardLevel
{
  int Stride = 1;
  int Iterations = 100;
};

struct StandardCurve
{
  struct Point
  {
    double Wall, Cpu; // s
    double E;         // at all frames
  };
  double Start = 0.0; // E0
  std::vector<Point> Points;

  /// Wall and processor seconds of the first point at or below this share of E0; -1: none.
  Point Passes(double share) const;
};

/// What the gas came to: must be none.
struct GasFaults
{
  std::size_t Outside = 0; // particle-frames outside the volume
  std::size_t Close = 0;   // pair-frames nearer than 0.3 dx
  double Nearest = 0.0;    // [dx]
};

double CpuSeconds();
double PeakMegabytes();

/// `state` ends as the solution. Prints a line every `every` iterations.
StandardCurve SolveStandard(const StandardProblem& problem,
                            const std::vector<StandardLevel>& levels, int history, int every,
                            const ParallelFor& parallel, StateVector& state);
GasFaults CheckGas(const SpacetimeModel& model, const StateVector& state);
/// Directed pairs within the support, of all frames, from every thirtieth.
double PairsWithinSupport(const SpacetimeModel& model, const StateVector& state);
/// Single-precision operations a second [1e9] of one core: fused multiplications and additions.
double PeakGigaflops();

} // namespace waft
