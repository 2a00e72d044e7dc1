// SPDX-License-Identifier: BSD-3-Clause
// Positions to start the search for one vortex.
#pragma once

#include "Vortex/VortexSearch.h"

namespace waft
{

/// A vortex guessed from the samples alone: its acceleration is perpendicular to its axis and to
/// the way to it, so that the axis is the direction of least acceleration and the center solves
/// linear equations f . (x - c) = 0; time and duration are moments of |f|.
VortexParameters GuessFromSamples(const std::vector<VortexSample>& samples);

/// The best strength for otherwise given parameters, beside a uniform background with a ridge; sets
/// Shape[LinearStrength] and returns the sum of squares that remains, robust (Cauchy, of scale).
double FitStrength(const std::vector<VortexSample>& samples, double scale,
                   VortexParameters& parameters);

/// The starts with the least remains out of many: the prior (always) or the guess, and perturbed
/// ones. Deterministic in options.Seed and stream.
std::vector<VortexParameters> ChooseStarts(const std::vector<VortexSample>& samples,
                                           const VortexParameters* prior,
                                           const VortexFitOptions& options,
                                           const VortexLimits& limits, double scale,
                                           std::uint64_t stream);

} // namespace waft
