// SPDX-License-Identifier: BSD-3-Clause
// From a scene's objects and shapes to bodies that turn, and from tracks to what they fly through.
#pragma once

#include "Rotation/Attitude.h"
#include "Rotation/RotationRefine.h"
#include "Rotation/StillAir.h"

namespace waft
{

/// How it turns was found with its path.
inline bool HasFlown(const Track& track)
{
  return !track.Slips.empty();
}

/// By the object's own coefficients: no two leaves are cut alike.
Glider GliderOf(const RotationInput& input, const RotationOptions& options,
                const PreparedShape& shape, const MotionObject& object);

/// What is not known yet of a shape. glider: a body of it where bodies glide, or null.
Result Prepare(const RotationInput& input, const RotationOptions& options, std::size_t shapeId,
               const MotionObject* glider, const ParallelFor& parallel, PreparedShape& shape);

/// What the i-th track flies through. draw [m/s]: of the weight of a body that glides; 0: its path
/// draws it. pace: seconds of the turning in a second.
FlightPath MakePath(const RotationInput& input, std::size_t i, double draw, double pace);

/// What lies is drawn by nothing, nor is what a surface brakes shortly before.
void EndDraw(const AttitudePlan& plan, FlightPath& path);

} // namespace waft
