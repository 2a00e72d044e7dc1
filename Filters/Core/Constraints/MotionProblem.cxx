// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/MotionProblem.h"

#include <string>

namespace waft
{

Result CheckTracks(const MotionProblem& problem, int leastFrames)
{
  if (problem.Tracks.empty())
  {
    return Result::Error("Tracks: no track, at least one expected");
  }
  const int frames = problem.Scene.Time.NumberOfFrames;
  if (frames < leastFrames)
  {
    return Result::Error("NumberOfFrames: at least " + std::to_string(leastFrames) +
                         " expected, found " + std::to_string(frames));
  }
  for (const Track& track : problem.Tracks)
  {
    const std::string name = "Tracks, object " + std::to_string(track.ObjectId);
    if (track.Positions.size() != static_cast<std::size_t>(frames))
    {
      return Result::Error(name + ": " + std::to_string(track.Positions.size()) +
                           " points, one a frame (" + std::to_string(frames) + ") expected");
    }
    if (!track.Slips.empty() && track.Slips.size() != track.Positions.size())
    {
      return Result::Error(name + ": Slip of " + std::to_string(track.Slips.size()) +
                           " frames, one a frame (" + std::to_string(frames) + ") expected");
    }
    for (std::size_t k = 0; k < track.Positions.size(); ++k)
    {
      if (!track.Positions[k].allFinite())
      {
        return Result::Error(name + ": not a finite position at frame " + std::to_string(k));
      }
    }
  }
  return Result::Ok();
}

} // namespace waft
