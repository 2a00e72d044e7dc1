// SPDX-License-Identifier: BSD-3-Clause
// Where rows ask an object to be, and whether it can come from one such position to the next in
// time.
#pragma once

#include "Base/Motion.h"
#include "Constraints/Constraint.h"
#include "Obstacles/ObstacleSet.h"
#include "Planning/SegmentLibrary.h"

#include <vector>

namespace waft
{

/// A position that is asked for from frame First to Last.
struct Stop
{
  int First = 0;
  int Last = 0;
  Vec3 Value = Vec3::Zero();    // as the row has it
  Vec3 Position = Vec3::Zero(); // where the object is then: of a rest on the surface
  Vec3 Leaves = Vec3::Zero();   // where it is at its Last frame
  double Radius = 0.0;          // m
  bool IsRest = false;
};

/// What a position or rest row asks for; a rest with nothing below as if it were in the air.
/// restHeight: of the object's centre [m].
Stop StopOf(const Constraint& row, double restHeight, const ObstacleSet& obstacles);

/// Where an object is until its release.
Stop StartOf(const MotionObject& object, const ObstacleSet& obstacles);

/// How far an object may come: what a flight takes to rise from rest, and to come to it, counts
/// half, unless it is so short that it is drawn.
class SpeedLimit
{
public:
  /// topStep: m per frame; shortestSpan: flights of fewer frames are drawn; tolerance: distance of
  /// positions that are taken as one [m].
  SpeedLimit(double topStep, double framesPerSecond, int shortestSpan, double tolerance);

  /// m in so many frames at the database's top speed.
  double Reach(int frames, bool launches, bool brakes) const;
  /// Length of the way from a stop to a later one, less both radii, over what can be flown at the
  /// database's top speed; infinite when they overlap in time at different positions. Beyond
  /// SpeedAllowance no path is tried.
  double Haste(const Stop& from, const Stop& to) const;

private:
  double TopStep; // m per frame
  int Second;     // frames
  int ShortestSpan;
  double Tolerance;
};

} // namespace waft
