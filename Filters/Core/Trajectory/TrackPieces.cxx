// SPDX-License-Identifier: BSD-3-Clause
#include "Trajectory/TrackPieces.h"

#include <algorithm>

namespace waft
{

namespace
{

double MeanSpeed(const Track& track, const SampleRange& range, double framesPerSecond)
{
  double length = 0.0;
  for (int i = range.First; i + 1 < range.First + range.Count; ++i)
  {
    length += (track.Positions[i + 1] - track.Positions[i]).norm();
  }
  return length * framesPerSecond / (range.Count - 1);
}

} // namespace

std::vector<TrackPiece> CutTracks(const std::vector<Track>& tracks, double framesPerSecond,
                                  double width, const SegmentationOptions& options,
                                  const std::vector<int>& lengths)
{
  const double feature =
    options.FeatureCurvature > 0.0 ? options.FeatureCurvature : 4.0 / std::max(width, 1e-12);
  std::vector<TrackPiece> pieces;
  for (std::size_t t = 0; t < tracks.size(); ++t)
  {
    const std::vector<double> curvature =
      CurvatureAlong(tracks[t].Positions, 1.0 / framesPerSecond);
    for (const SampleRange& range : CutPath(curvature, options, feature))
    {
      const auto above = std::upper_bound(lengths.begin(), lengths.end(), range.Count);
      const int length = static_cast<int>(above - lengths.begin()) - 1;
      if (length < 0)
      {
        continue;
      }
      const SampleRange kept = Truncate(range, lengths[length], curvature);
      if (MeanSpeed(tracks[t], kept, framesPerSecond) >= options.LeastSpeed)
      {
        pieces.push_back({ static_cast<int>(t), kept, length });
      }
    }
  }
  return pieces;
}

std::vector<Vec3> PositionsOf(const std::vector<Track>& tracks, const TrackPiece& piece)
{
  const auto first = tracks[piece.Track].Positions.begin() + piece.Range.First;
  return { first, first + piece.Range.Count };
}

} // namespace waft
