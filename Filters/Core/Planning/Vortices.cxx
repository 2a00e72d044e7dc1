// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/Vortices.h"

#include <map>

namespace waft
{

namespace
{

Vortex CarryVortex(const Vortex& source, const SegmentUse& use, int id)
{
  Vortex vortex = source;
  vortex.VortexId = id;
  vortex.P1 = use.Transform * source.P1;
  vortex.P2 = use.Transform * source.P2;
  // Played faster by a factor, the same path needs accelerations larger by its square.
  vortex.Strength *= use.RetimingFactor * use.RetimingFactor;
  vortex.CenterTime = use.FirstTime + source.CenterTime / use.RetimingFactor;
  vortex.Duration = source.Duration / use.RetimingFactor;
  vortex.ObjectCount = 1;
  return vortex;
}

} // namespace

void Annotate(const SegmentLibrary& library, const std::vector<SegmentUse>& uses,
              const std::vector<UseSample>& samples, double framesPerSecond, Track& track,
              std::vector<Vortex>& vortices)
{
  const MotionDatabase& database = library.Database();
  const std::size_t count = track.Positions.size();
  track.ForceTypes.assign(count, ForceType::None);
  track.VortexIds.assign(count, -1);
  track.VortexAccelerations.assign(count, Vec3::Zero());
  track.WindAccelerations.assign(count, Vec3::Zero());
  std::map<std::pair<int, int>, int> carried; // (use, vortex of the database) -> index in vortices
  for (std::size_t frame = 0; frame < count; ++frame)
  {
    const UseSample& sample = samples[frame];
    if (sample.Use < 0)
    {
      continue;
    }
    const SegmentUse& use = uses[static_cast<std::size_t>(sample.Use)];
    const Segment& segment = database.Segments[use.Segment];
    if (segment.ForceTypes.empty())
    {
      continue;
    }
    const int at = library.DatabaseSample(use.Segment, sample.Sample);
    track.ForceTypes[frame] = segment.ForceTypes[at];
    track.WindAccelerations[frame] =
      use.Transform.Rotation * segment.MeanWind * (use.RetimingFactor * use.RetimingFactor);
    const int source = segment.VortexIds.empty() ? -1 : segment.VortexIds[at];
    if (source < 0)
    {
      continue;
    }
    const auto [entry, isNew] =
      carried.emplace(std::pair(sample.Use, source), static_cast<int>(vortices.size()));
    if (isNew)
    {
      vortices.push_back(CarryVortex(database.Vortices[source], use, entry->second));
    }
    const Vortex& vortex = vortices[static_cast<std::size_t>(entry->second)];
    track.VortexIds[frame] = vortex.VortexId;
    track.VortexAccelerations[frame] =
      vortex.Acceleration(track.Positions[frame], static_cast<double>(frame) / framesPerSecond);
  }
}

} // namespace waft
