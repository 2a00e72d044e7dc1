// SPDX-License-Identifier: BSD-3-Clause
// A sampled flow as the tracer reads it.
#pragma once

#include "Base/Result.h"
#include "Trajectory/TrajectoryTracer.h"

class vtkImageData;

namespace waft
{

/// Fails when the image is turned or has no points.
Result FlowLatticeFromImage(vtkImageData* data, FlowLattice& lattice);

/// Needs the point data `Velocity`; `VortexForce` and `WindForce` are read when present. Each has
/// three components.
Result FlowFrameFromImage(vtkImageData* data, double time, FlowFrame& frame);

} // namespace waft
