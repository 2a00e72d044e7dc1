// SPDX-License-Identifier: BSD-3-Clause
// Tracks: one polyline an object, one point a frame.
#pragma once

#include "Base/Motion.h"
#include "Base/Result.h"
#include "Base/Types.h"

#include <string>
#include <vector>

class vtkPolyData;

namespace waft
{

/// Points in the order of the tracks, then of frames; `Velocity` is the central difference of the
/// positions. Annotations that a track does not have are written as none; `Force`, `AirVelocity`
/// `SPHVelocity` and `Residual` are written when the tracks have them.
void TracksToPolyData(const std::vector<Track>& tracks, const SceneInfo& info, vtkPolyData* data);

/// One track per line cell, in the order of the cells; needs the cell data `ObjectId`. input: what
/// the data are called in messages.
Result TracksFromPolyData(vtkPolyData* data, std::vector<Track>& tracks,
                          const std::string& input = "Tracks");
/// The same with their objects and places alone.
Result PathsFromPolyData(vtkPolyData* data, std::vector<Track>& tracks, const std::string& input);

} // namespace waft
