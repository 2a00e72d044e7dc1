// SPDX-License-Identifier: BSD-3-Clause
// The air at every frame of every track.
#pragma once

#include "Base/FieldSeries.h"
#include "Base/Motion.h"
#include "Base/Result.h"
#include "Base/Types.h"

#include <cstddef>
#include <vector>

namespace waft
{

/// The air's velocity and its gradient at the positions of tracks, taken from one field after
/// another: a long series is never kept whole. Linear in time between two fields, held before the
/// first and after the last one.
class AirOnTracks
{
public:
  AirOnTracks() = default;
  /// Tracks have to stay where they are until Finish.
  AirOnTracks(const std::vector<Track>& tracks, const Timeline& time);
  /// As another one says it, by track and frame.
  AirOnTracks(const std::vector<std::vector<Vec3>>& velocities,
              const std::vector<std::vector<Mat3>>& gradients);
  /// The fields that follow those added before, on the same lattice: velocities [m/s]. Fails where
  /// they are accelerations, are earlier, or FieldSeries::Validate does.
  Result Add(FieldSeries fields);
  /// After the last field.
  void Finish();

  /// Nothing is said of the air.
  bool IsEmpty() const { return this->Last.IsEmpty() && this->Samples.empty(); }
  /// m/s, at a frame of the i-th track.
  Vec3 Velocity(std::size_t i, std::size_t frame) const;
  /// d u_r / d x_c [1/s].
  Mat3 Gradient(std::size_t i, std::size_t frame) const;

private:
  struct Sample
  {
    Eigen::Vector3f Velocity;
    Eigen::Matrix3f Gradient;
  };
  /// Samples the frames up to a time.
  void SampleUntil(double time);

  const std::vector<Track>* Tracks = nullptr;
  Timeline Time;
  FieldSeries Last;                         // the fields about the next frame
  std::vector<std::vector<Sample>> Samples; // [track][frame]
  std::size_t Frames = 0;                   // sampled so far
  std::size_t NumberOfFrames = 0;
};

} // namespace waft
