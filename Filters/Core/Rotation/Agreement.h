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

/// The slips [m/s] of a body along its path in the air there, by the poses and rates of turning
/// that it came with: from its first one on wherever nothing but the air bears it. Elsewhere they
/// are those that it came with, which the others go over to within half a second.
std::vector<Vec3> SlipsAlong(const AttitudePlan& plan, const FlightBody& body,
                             const FlightPath& path);

/// Median and 90th percentile of what TurnedAway tells, linear between ranks [rad]; NaN of none.
std::array<double, 2> AgreementOf(std::vector<double> away);

} // namespace waft
