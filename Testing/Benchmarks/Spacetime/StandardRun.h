// SPDX-License-Identifier: BSD-3-Clause
// The standard problem solved by the optimiser's own program of levels, and once more as when a run
// is continued, without leash and fields; E is measured at all frames on the way, off the clock.
// What an evaluation costs.
#pragma once

#include "Base/Parallel.h"
#include "Spacetime/Scene/SpacetimeSetup.h"

#include <vector>

namespace waft
{

struct StandardCurve
{
  struct Point
  {
    double Wall, Cpu; // s
    double E;         // at all frames
  };
  double Start = 0.0; // E0
  std::vector<Point> Points;
  std::size_t Evaluations = 0; // of value and gradient, at all levels

  /// Wall and processor seconds of the first point at or below this fraction of E0; -1: none.
  Point Passes(double fraction) const;
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

/// An evaluation of value and gradient at all frames, lists up to date, means of three.
struct EvaluationCost
{
  double Cpu = 0.0, Wall = 0.0; // s
  double WallAlone = 0.0;       // s, on one thread; 0: not measured
  double Pair = 0.0;            // ns of Cpu a directed pair within the support
  double ParticleFrame = 0.0;   // us of Cpu a particle and frame
  double PeakFraction = 0.0;    // of the machine's peak, counted operations; 0: not known
};

/// alone: measures one thread, too.
EvaluationCost MeasureCost(const SpacetimeSetup& setup, const StateVector& state,
                           const ParallelFor& parallel, const SphKernelTable& kernels, bool alone);

/// From setup.Start to `state`. Prints a line every `every` iterations.
StandardCurve SolveStandard(const SpacetimeSetup& setup, const SpacetimeOptions& options, int every,
                            const ParallelFor& parallel, StateVector& state);
GasFaults CheckGas(const SpacetimeModel& model, const StateVector& state);
/// Directed pairs within the support, of all frames, from every thirtieth.
double PairsWithinSupport(const SpacetimeModel& model, const StateVector& state);
/// Single-precision operations a second [1e9] of one core: fused multiplications and additions.
double PeakGigaflops();

} // namespace waft
