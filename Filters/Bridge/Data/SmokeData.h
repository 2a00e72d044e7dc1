// SPDX-License-Identifier: BSD-3-Clause
// Smoke as an image.
#pragma once

#include "Grid/SmokeSeries.h"

class vtkImageData;

namespace waft
{

/// Voxel centres become the image's points. Point data `Velocity`, `Vorticity`, `VortexForce`,
/// `WindForce` (float[3]), `Density`, `Pressure` (float), `Obstacle` (unsigned char).
void SmokeFrameToImage(const SmokeFrame& frame, const SceneInfo& info, vtkImageData* data);

} // namespace waft
