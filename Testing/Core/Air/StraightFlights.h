// SPDX-License-Identifier: BSD-3-Clause
// Small scenes of what flies straight to its row.
#pragma once

#include "Base/Primitives.h"
#include "Constraints/MotionProblem.h"

#include <algorithm>

namespace waft
{

/// A ground whose upper side is at height 0.
inline ObstacleMesh FlatGround()
{
  ObstacleMesh ground;
  ground.Mesh = MakeBox({ Vec3(-3.0, -3.0, -1.0), Vec3(3.0, 3.0, 0.0) });
  return ground;
}

/// Adds an object, its row, and the straight plan from one to the other: of a rest down to where
/// the object lies on the ground.
inline void AddStraightFlight(const MotionObject& object, const Constraint& row, int frames,
                              MotionProblem& problem)
{
  problem.Objects.push_back(object);
  problem.Constraints.push_back(row);
  Vec3 end = row.Value;
  end.z() = row.Kind == ConstraintKind::Rest ? object.RestHeight : end.z();
  Track track;
  track.ObjectId = object.ObjectId;
  for (int f = 0; f < frames; ++f)
  {
    const double s = std::min(1.0, f / static_cast<double>(row.Frame));
    track.Positions.push_back((1.0 - s) * object.Position + s * end);
  }
  problem.Tracks.push_back(track);
}

} // namespace waft
