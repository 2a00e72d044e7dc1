// SPDX-License-Identifier: BSD-3-Clause
// Which samples concern a vortex, and when two vortices are one.
#pragma once

#include "Vortex/VortexFit.h"

#include <set>
#include <vector>

namespace waft
{

/// Samples that are claimed by one of `claims`, and those of any track within four core radii (or
/// 0.15 L if more) of the axis and 2.5 durations of the center time. Samples without weight never.
std::vector<VortexSample> SamplesOf(const Vortex& vortex, const std::set<int>& claims,
                                    const std::vector<VortexSample>& samples, double width);

/// Tracks with at least 5 samples at which the field is over a quarter of its greatest.
int CountWitnesses(const Vortex& vortex, const std::vector<VortexSample>& samples);

/// Nearer than MergeDistance, MergeAngle and MergeTime; axes may point either way.
bool AreDuplicates(const Vortex& a, const Vortex& b, const VortexFitOptions& options);

/// The samples within 0.2 L and 1.5 s of the sample with most energy (acceleration squared);
/// region: their numbers. Looks about the 24 strongest samples that lie apart from each other.
std::vector<VortexSample> StrongestRegion(const std::vector<VortexSample>& samples, double width,
                                          std::vector<std::size_t>& region);

} // namespace waft
