// SPDX-License-Identifier: BSD-3-Clause
// One object's rows as marks along its time line.
#pragma once

#include "Base/Motion.h"
#include "Constraints/Constraint.h"
#include "Constraints/Rest.h"
#include "Constraints/Warp.h"
#include "Planning/Guide.h"

#include <vector>

namespace waft
{

struct Mark
{
  int Frame = 0;
  int Until = 0; // larger than Frame when the object lies still
  Vec3 Position = Vec3::Zero();
  CarriedPlace Place; // of what it lies or hangs on, until Until
  double Radius = 0.0;
  bool IsRest = false;
  bool Halts = false; // asked to have no speed, though in the air
  bool HasVelocity = false;
  Vec3 Velocity = Vec3::Zero(); // m per frame
  int Constraint = -1;          // index in the scene's list, -1: the start
};

/// A velocity or acceleration row in terms of positions, met within Radius [m, scaled as the row].
struct MotionRow
{
  LinearRow Row;
  double Radius = 0.0;
};

struct Itinerary
{
  std::vector<Mark> Marks;             // by frame, the first at frame 0
  std::vector<LandingWindow> Landings; // of the rests among the marks
  std::vector<MotionRow> Rows;
  GuideWay Way; // empty: none

  /// Takes up a guide; after the last mark it leads to its own end, within `radius` [m].
  void Follow(const std::vector<Vec3>& points, double radius, const SceneInfo& scene);
};

/// rows: all constraints of the scene; places: the object's own among them; isUsed: one a row,
/// those that are false are passed over, and so are rests with nothing below. Where two rows speak
/// of one frame the tighter one counts.
Itinerary MakeItinerary(const MotionObject& object, const std::vector<Constraint>& rows,
                        const std::vector<std::size_t>& places,
                        const std::vector<unsigned char>& isUsed, const ObstacleSet& obstacles,
                        const SceneInfo& scene);

} // namespace waft
