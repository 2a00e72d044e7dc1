// SPDX-License-Identifier: BSD-3-Clause
// What the stages take that move objects to their marks.
#pragma once

#include "Base/FieldSeries.h"
#include "Base/ForceFields.h"
#include "Base/Mesh.h"
#include "Base/Motion.h"
#include "Base/Result.h"
#include "Constraints/Constraint.h"

#include <vector>

namespace waft
{

struct MotionProblem
{
  SceneInfo Scene;
  std::vector<Track> Tracks;           // planned, one an object, one sample a frame
  std::vector<MotionObject> Objects;   // those of the tracks
  std::vector<Constraint> Constraints; // every row assigned
  std::vector<ObstacleMesh> Obstacles; // the ground among them
  std::vector<Vortex> Vortices;
  FieldSeries Wind; // the user's, or empty

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.Scene...);
    visit(of.Tracks...);
    visit(of.Objects...);
    visit(of.Constraints...);
    visit(of.Obstacles...);
    visit(of.Vortices...);
    visit(of.Wind...);
  }
};

/// At least one track, at least so many frames, in each track one finite position a frame.
Result CheckTracks(const MotionProblem& problem, int leastFrames);

} // namespace waft
