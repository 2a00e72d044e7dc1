// SPDX-License-Identifier: BSD-3-Clause
// One vortex against one list of samples.
#pragma once

#include "Vortex/VortexFit.h"
#include "Vortex/VortexModel.h"

#include <vector>

namespace waft
{

/// Box bounds of the parameters.
struct VortexLimits
{
  Box Center; // m
  ShapeVector Low = ShapeVector::Zero();
  ShapeVector High = ShapeVector::Zero();

  explicit VortexLimits(const VortexFitOptions& options);
  void Clamp(VortexParameters& parameters) const;
};

struct VortexSearchResult
{
  VortexParameters Parameters;
  Vec3 Background = Vec3::Zero(); // m/s^2
  double Cost = 0.0;
  double Noise = 0.0;     // m/s^2, robust, of one component
  double Explained = 0.0; // 0..1 of the energy of acceleration less background
  double Precision = 0.0; // 0..1, see FitVortices
};

/// samples: at least 4; Acceleration is what the other vortices leave. start: where to start first,
/// or nullptr; prior: what to believe, or nullptr. stream: of the random numbers.
VortexSearchResult SearchVortex(const std::vector<VortexSample>& samples,
                                const VortexParameters* start, const VortexParameters* prior,
                                const VortexFitOptions& options, std::uint64_t stream,
                                Monitor& monitor, bool& stopped);

} // namespace waft
