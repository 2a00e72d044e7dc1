// SPDX-License-Identifier: BSD-3-Clause
// A sampled flow as the tracer reads it.
#pragma once

#include "Base/Result.h"
#include "Trajectory/TrajectoryTracer.h"

#include <vector>

class vtkImageData;

namespace waft
{

/// Needs the point data `Velocity`; `VortexForce` and `WindForce` are read when present. Each has
/// three components.
Result FlowFrameFromImage(vtkImageData* data, double time, FlowFrame& frame);

/// The solid part of a flow as voxels; none when the image does not say.
struct SolidVoxels
{
  PointLattice Lattice;
  std::vector<unsigned char> Values; // 0 air, else solid

  /// By the trilinear mean of the voxels around x, so that a wall between two centres stands half
  /// way.
  bool Contains(const Vec3& x) const;
};

/// The point data `Obstacle`, when it is there.
void SolidVoxelsFromImage(vtkImageData* data, const PointLattice& lattice, SolidVoxels& solid);

} // namespace waft
