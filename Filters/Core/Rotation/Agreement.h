// SPDX-License-Identifier: BSD-3-Clause
// Whether poses that were found with a path are those of the air that the body ends up in.
#pragma once

#include "Rotation/Attitude.h"

#include <array>
#include <cstddef>
#include <vector>

namespace waft
{

/// Which poses of a body's flight are looked at.
struct AgreementSample
{
  int First = 0;   // frames
  int Stride = 10; // likewise
};

/// Of the i-th of so many bodies: every tenth. Of more than 2048 bodies as many in all as
/// of these, of each at other frames: as good for percentiles of all, and less work.
AgreementSample AgreementSampleOf(std::size_t i, std::size_t bodies);

/// From poses of a body's flight on it is turned again for half a second in the air
/// along its path and by the surfaces there, from its own turning and slip: how far that leads away
/// from its poses [rad], as they are in the end. In the order of frames; without those where rests
/// or orientation rows turn it. Tumbling is chaotic: over longer times no two flights agree.
std::vector<double> TurnedAway(const AttitudePlan& plan, const FlightBody& body,
                               const FlightPath& path, const PoseTrack& poses,
                               const AgreementSample& sample = AgreementSample());

/// Median and 90th percentile of that, linear between ranks [rad]; NaN of none.
std::array<double, 2> AgreementOf(std::vector<double> away);

} // namespace waft
