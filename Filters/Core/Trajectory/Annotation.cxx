// SPDX-License-Identifier: BSD-3-Clause
#include "Trajectory/Annotation.h"

#include <cmath>

namespace waft
{

ForceType ClassifyForce(const Vec3& vortexForce, const Vec3& windForce,
                        const AnnotationOptions& options)
{
  const double vortex = vortexForce.norm();
  const double wind = windForce.norm();
  if (vortex > options.VortexShare * (vortex + wind) && vortex > options.ForceFloor)
  {
    return ForceType::Vortex;
  }
  return wind > options.ForceFloor ? ForceType::Wind : ForceType::None;
}

int DominantVortex(const std::vector<Vortex>& vortices, const Vec3& x, double time)
{
  int dominant = -1;
  double strongest = 0.0;
  for (const Vortex& vortex : vortices)
  {
    const double force = vortex.Acceleration(x, time).norm();
    if (force > strongest)
    {
      strongest = force;
      dominant = vortex.VortexId;
    }
  }
  return dominant;
}

void AnnotateTrack(const std::vector<Vortex>& vortices, double startTime, double framesPerSecond,
                   const AnnotationOptions& options, Track& track)
{
  const std::size_t count = track.Positions.size();
  track.ForceTypes.assign(count, ForceType::None);
  track.VortexIds.assign(count, -1);
  for (std::size_t i = 0; i < count; ++i)
  {
    track.ForceTypes[i] =
      ClassifyForce(track.VortexAccelerations[i], track.WindAccelerations[i], options);
    if (track.ForceTypes[i] == ForceType::Vortex)
    {
      const double time = startTime + static_cast<double>(i) / framesPerSecond;
      track.VortexIds[i] = DominantVortex(vortices, track.Positions[i], time);
    }
  }

  const auto isSame = [&](std::size_t a, std::size_t b) {
    return track.ForceTypes[a] == track.ForceTypes[b] && track.VortexIds[a] == track.VortexIds[b];
  };
  const auto copyCause = [&](std::size_t from, std::size_t begin, std::size_t end)
  {
    for (std::size_t i = begin; i < end; ++i)
    {
      track.ForceTypes[i] = track.ForceTypes[from];
      track.VortexIds[i] = track.VortexIds[from];
    }
  };
  const double shortest = options.ShortestRun * framesPerSecond;
  std::size_t kept = 0; // where the first run that is long enough begins, once there is one
  bool hasKept = false;
  for (std::size_t begin = 0; begin < count;)
  {
    std::size_t end = begin + 1;
    while (end < count && isSame(end, begin))
    {
      ++end;
    }
    const bool isLong = static_cast<double>(end - begin) + 1e-9 >= shortest;
    if (!isLong && hasKept)
    {
      copyCause(begin - 1, begin, end);
    }
    else if (isLong && !hasKept)
    {
      hasKept = true;
      kept = begin;
    }
    begin = end;
  }
  if (hasKept)
  {
    copyCause(kept, 0, kept); // short runs at the start have none before them
  }
}

} // namespace waft
