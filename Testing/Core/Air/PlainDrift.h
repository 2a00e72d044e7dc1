// SPDX-License-Identifier: BSD-3-Clause
// Drift as its documentation has it, slowly and with nothing shared with Air/Drift/Drift.cxx: what
// SolveDrift is held against.
#pragma once

#include "Air/Drift/Drift.h"

namespace waft
{

/// The same series in floats.
FieldSeries Unpacked(const HalfSeries& air);

/// The cost of a path of flight alone [m^2/s].
double PlainDriftCost(const DriftProblem& problem, const FieldSeries& air,
                      const DriftWeights& weights, const std::vector<Vec3>& path);

/// Levenberg's method on all frames that are not fixed, with a dense matrix and derivatives by
/// central differences. What it came to [m^2/s].
double PlainSolveDrift(const DriftProblem& problem, const FieldSeries& air,
                       const DriftWeights& weights, int maximumIterations, std::vector<Vec3>& path);

} // namespace waft
