// SPDX-License-Identifier: BSD-3-Clause
// The air's velocity between two frames, with its gradient.
#pragma once

#include "Base/HalfSeries.h"

namespace waft
{

/// Of a series whose k-th field is that of frame k, on a lattice of at least two points along x.
class AirSampler
{
public:
  explicit AirSampler(const HalfSeries& air);
  /// Half way from frame k to the next, at x [m]: trilinear, held at the lattice's ends, where the
  /// gradient d u_i / d x_j [1/s] across them is 0. [m/s]
  Vec3 Between(int k, const Vec3& x, Mat3* gradient = nullptr) const;
  /// At a frame.
  Vec3 At(int frame, const Vec3& x, Mat3* gradient = nullptr) const;

private:
  // Where x lies: its voxel's lowest corner, how far the others are from it in the list of values
  // (0 where there is none; along x at 1), the offset within it from 0 to 1, and 1 / spacing where
  // a move changes it.
  struct Voxel
  {
    std::size_t Corner = 0;
    std::size_t Next[3];
    double Part[3];
    double Slope[3];
  };
  Voxel Find(const Vec3& x) const;
  template <class Corners>
  static Vec3 Interpolate(const Voxel& voxel, const Corners& corners, Mat3* gradient);

  const HalfSeries& Air;
  Vec3 Slopes; // 1 / spacing
};

} // namespace waft
