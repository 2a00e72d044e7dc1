// SPDX-License-Identifier: BSD-3-Clause
#include "Vortex/VortexSamples.h"

#include <algorithm>
#include <string>

namespace waft
{

Result SamplesFromTracks(const std::vector<Track>& tracks, const Timeline& time, bool subtractWind,
                         std::vector<VortexSample>& samples)
{
  samples.clear();
  for (std::size_t t = 0; t < tracks.size(); ++t)
  {
    const Track& track = tracks[t];
    const std::size_t frames = track.Positions.size();
    if (track.Forces.size() != frames)
    {
      return Result::Error("Tracks: object " + std::to_string(track.ObjectId) +
                           " has no point data `Force`, expected tracks of the optimiser");
    }
    for (std::size_t k = 0; k < frames; ++k)
    {
      VortexSample sample;
      sample.Track = static_cast<int>(t);
      sample.Frame = static_cast<int>(k);
      sample.Time = time.Time(static_cast<double>(k));
      sample.Position = track.Positions[k];
      sample.Acceleration = track.Forces[k];
      sample.Weight = track.Forces[k] == Vec3::Zero() ? 0.0 : 1.0;
      if (subtractWind && track.WindAccelerations.size() == frames)
      {
        sample.Acceleration -= track.WindAccelerations[k];
      }
      if (track.VortexIds.size() == frames && track.ForceTypes.size() == frames &&
          track.ForceTypes[k] == ForceType::Vortex)
      {
        sample.VortexId = track.VortexIds[k];
      }
      samples.push_back(sample);
    }
  }
  return Result::Ok();
}

Result TakeAirAccelerations(const Timeline& time, std::vector<Track>& tracks)
{
  for (Track& track : tracks)
  {
    const std::vector<Vec3>& air = track.AirVelocities;
    const std::size_t frames = track.Positions.size();
    if (air.size() != frames)
    {
      return Result::Error(
        "Tracks: object " + std::to_string(track.ObjectId) +
        " has no point data `AirVelocity`, expected tracks of the assimilation or "
        "of the optimiser");
    }
    track.Forces.assign(frames, Vec3::Zero());
    for (std::size_t k = 0; k < frames && frames > 1; ++k)
    {
      const std::size_t before = k > 0 ? k - 1 : k;
      const std::size_t after = std::min(k + 1, frames - 1);
      track.Forces[k] =
        (air[after] - air[before]) / (static_cast<double>(after - before) * time.Step());
    }
    track.WindAccelerations.clear();
    track.VortexIds.clear();
    track.ForceTypes.clear();
  }
  return Result::Ok();
}

std::vector<Vec3> VortexForces(const Track& track, const std::vector<Vortex>& vortices,
                               const Timeline& time)
{
  std::vector<Vec3> forces(track.Positions.size(), Vec3::Zero());
  for (std::size_t k = 0; k < forces.size(); ++k)
  {
    for (const Vortex& vortex : vortices)
    {
      forces[k] += vortex.Acceleration(track.Positions[k], time.Time(static_cast<double>(k)));
    }
  }
  return forces;
}

} // namespace waft
