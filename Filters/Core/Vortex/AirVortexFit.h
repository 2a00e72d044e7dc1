// SPDX-License-Identifier: BSD-3-Clause
// Vortices that explain how the air about some tracks turns them, and how much of it.
#pragma once

#include "Base/ForceFields.h"
#include "Base/Monitor.h"
#include "Base/Motion.h"
#include "Base/Result.h"
#include "Vortex/VortexFit.h"

#include <limits>
#include <vector>

namespace waft
{

struct AirVortexFit
{
  std::vector<Vortex> Vortices;
  /// 1 - sum |a - sum of vortices|^2 / sum |a|^2 over all tracks, a what TakeAirAccelerations
  /// takes.
  double Explained = 0.0;
  /// The same of every fifth track by a fit that did not see it; NaN where there are fewer than
  /// five.
  double ExplainedLeftOut = std::numeric_limits<double>::quiet_NaN();
};

/// Fits vortices to the accelerations of the air about the tracks, then their strengths together by
/// least squares with a ridge: each was fitted to what the others leave where it is felt. found: as
/// far as it came when stopped. Errors: those of TakeAirAccelerations and of FitVortices.
Result FitAirVortices(const std::vector<Track>& tracks, const Timeline& time,
                      const std::vector<Vortex>& priors, const VortexFitOptions& options,
                      Monitor& monitor, AirVortexFit& found);

} // namespace waft
