// SPDX-License-Identifier: BSD-3-Clause
// The parts of traced trajectories that become segments.
#pragma once

#include "Base/Motion.h"
#include "Base/Types.h"
#include "Trajectory/Segmentation.h"

#include <vector>

namespace waft
{

struct TrackPiece
{
  int Track = 0; // index in the list of tracks
  SampleRange Range;
  int Length = 0; // index in GroupLengths; Range has as many samples as it says
};

/// Cuts the tracks of one run between their features and truncates each part to the next of the
/// lengths below; parts that are shorter than all of them or slower than LeastSpeed are left out.
/// width: of the volume [m], which the default FeatureCurvature is measured by.
std::vector<TrackPiece> CutTracks(const std::vector<Track>& tracks, double framesPerSecond,
                                  double width, const SegmentationOptions& options,
                                  const std::vector<int>& lengths);

/// The positions of a piece [m].
std::vector<Vec3> PositionsOf(const std::vector<Track>& tracks, const TrackPiece& piece);

} // namespace waft
