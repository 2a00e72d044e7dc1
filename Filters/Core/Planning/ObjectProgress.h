// SPDX-License-Identifier: BSD-3-Clause
// The path of one object as far as it is flown: kept span by span, and gone back to where a flight
// found no way on.
#pragma once

#include "Constraints/Warp.h"
#include "Planning/ClearanceField.h"
#include "Planning/ObjectPlan.h"

#include <vector>

namespace waft
{

/// A value: a copy is a state to return to.
struct ObjectProgress
{
  /// margin: kept beyond the clearance radius [m]. The obstacles must outlive the progress.
  ObjectProgress(const MotionObject& object, const Itinerary& itinerary,
                 const ObstacleSet& obstacles, const SceneInfo& scene, double margin);

  /// A frame whose position is given.
  void Fix(int frame, const Vec3& position);
  /// Rests from the mark's frame until it ends.
  void LieStill(const Mark& mark);
  /// A mark of Way that was not reached: the object goes on from where it came to, and what was
  /// held there is void.
  void Miss(Mark& mark, const Vec3& position);
  /// Adds a span that was flown; its trees are taken from it. gauge: whose history it keeps, or
  /// null.
  void Keep(const SegmentLibrary& library, const StyleGauge* gauge, const Timeline& time,
            const SpanRequest& request, SpanResult& span);

  Itinerary Way; // marks that are missed become positions where the object just was
  ClearanceField Field;
  ObjectPlan Plan;
  WarpProblem Warp;
  bool HasContinuation = false;
  Piece Continuation;
  bool Halted = false;     // the flight before came to a stop
  bool LastReached = true; // the mark before
  bool IsRuledOut = false; // it could not be, however the flight began
  std::vector<int> Seams;  // frames at which two flights meet
  StyleHistory History;
};

} // namespace waft
