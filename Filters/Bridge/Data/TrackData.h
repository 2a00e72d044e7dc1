// SPDX-License-Identifier: BSD-3-Clause
// Tracks: one polyline an object, one point a frame.
#pragma once

#include "Base/Motion.h"
#include "Base/Result.h"
#include "Base/Types.h"

#include <string>
#include <vector>

class vtkPointData;
class vtkPolyData;

namespace waft
{

/// Points in the order of the tracks, then of frames; `Velocity` is the central difference of the
/// positions. Annotations that a track does not have are written as none; `Force`, `AirVelocity`
/// `SPHVelocity` and `Residual` are written when the tracks have them. left: arrays of these points
/// by FlightsFromPolyData, which become the output's own.
void TracksToPolyData(const std::vector<Track>& tracks, const SceneInfo& info, vtkPolyData* data,
                      vtkPointData* left = nullptr);

/// One track per line cell, in the order of the cells; needs the cell data `ObjectId`. input: what
/// the data are called in messages.
Result TracksFromPolyData(vtkPolyData* data, std::vector<Track>& tracks,
                          const std::string& input = "Tracks");
/// The same without annotations that are as TracksToPolyData writes them: these are put into `left`
/// as they are, since of many bodies they would be most of the memory a second time.
Result FlightsFromPolyData(vtkPolyData* data, std::vector<Track>& tracks, vtkPointData* left);
/// The same with their objects and places alone.
Result PathsFromPolyData(vtkPolyData* data, std::vector<Track>& tracks, const std::string& input);

} // namespace waft
