// SPDX-License-Identifier: BSD-3-Clause
// The air's velocity between two frames, with its gradient.
#pragma once

#include "Base/FieldSeries.h"

namespace waft
{

/// Of a FieldSeries whose k-th field is that of frame k.
class AirSampler
{
public:
  explicit AirSampler(const FieldSeries& air);
  /// Half way from frame k to the next, at x [m]: trilinear, held at the lattice's ends, where the
  /// gradient d u_i / d x_j [1/s] across them is 0. [m/s]
  Vec3 Between(int k, const Vec3& x, Mat3& gradient) const;
  /// At a frame.
  Vec3 At(int frame, const Vec3& x) const;

private:
  struct Voxel
  {
    std::size_t Corner[8];
    double Weight[8];
    Vec3 Slope[8]; // of the weights [1/m]
  };
  Voxel Find(const Vec3& x) const;

  const FieldSeries& Air;
};

} // namespace waft
