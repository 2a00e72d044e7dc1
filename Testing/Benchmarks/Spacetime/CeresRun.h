// SPDX-License-Identifier: BSD-3-Clause
// A standard problem small enough for Ceres, solved by it and by Waft's solver from the same start.
#pragma once

#include "Base/Parallel.h"
#include "StandardProblem.h"

#include <vector>

namespace waft
{

struct SolverEnd
{
  double Cost = 0.0;    // E in double precision
  double Seconds = 0.0; // of the processor
  int Evaluations = 0;  // of E and its gradient
};

/// Unknowns as ReferenceObjective has them, with gas that left the box put back to its walls.
std::vector<double> HeldInBox(const SpacetimeModel& model, const double* z, std::size_t size);
/// Takes from a gradient at `z`, held as `held`, what moves fixed places or gas out of the box.
void HoldGradient(const SpacetimeModel& model, const double* z, const std::vector<double>& held,
                  double* gradient);

struct CeresComparison
{
  double Start = 0.0; // E
  SolverEnd Ceres, Waft;
};

/// Ceres: L-BFGS with a Wolfe line search on E in double precision by brute force; its
/// Levenberg-Marquardt would need the Jacobian, whose blocks of a frame are dense. Both keep the
/// fixed places and the gas in its box; Ceres sees gas beyond a wall at the wall. The term that
/// keeps gas apart is left out.
CeresComparison CompareWithCeres(StandardProblem& problem, int iterations, int ceresIterations,
                                 const ParallelFor& parallel);

} // namespace waft
