// SPDX-License-Identifier: BSD-3-Clause
// One object from the first frame to the last: free flight between orientation rows and rests.
#pragma once

#include "Base/Motion.h"
#include "Base/Pose.h"
#include "Base/Shape.h"
#include "Constraints/Constraint.h"
#include "Constraints/Rest.h"
#include "Rotation/Flight.h"

#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace waft
{

/// One rest of an object.
struct PlannedRest : LandingWindow
{
  int Deadline = 0; // it lies still from this frame on at the latest
  FaceUp Side = FaceUp::Any;
};

/// When a rest of the flown poses began.
struct RestTimes
{
  int Row = 0;
  int Target = 0;
  int TouchDown = 0; // frame of the first contact
  int Settled = 0;   // frame from which it is still
};

/// What happens to one object; rests do not overlap and are in order, keys are in order of Frame.
struct AttitudePlan
{
  const MotionObject* Object = nullptr;
  const Track* Path = nullptr;
  const Shape* Body = nullptr;
  double BoundingRadius = 0.0;    // m
  std::vector<PlannedRest> Rests; // ObstacleId -1: nothing below, it hangs level
  std::vector<Constraint> Keys;   // orientation rows, and positions that ask where it faces
  const ObstacleSet* Obstacles = nullptr;
  Timeline Time;
  std::uint64_t Seed = 1;    // of the pose in flight, where the object has none given
  double LandingTime = 0.7;  // s
  double TurningTime = 2.0;  // s
  double TurningRate = 60.0; // rad/s, the most that an orientation row may ask for
  bool Glides = false;       // how it slips is wanted
  // Poses that the path came with are kept but for those after the first of these frames, up to the
  // other, where they may jump back to those.
  int TurnsFrom = std::numeric_limits<int>::max();
  int TurnsUntil = std::numeric_limits<int>::max();
  std::vector<int> Held;         // frames where rows hold the centre: it is not moved there
  std::vector<Constraint> Stays; // positions at which it is held for a while
  double Tolerance = 0.0; // m: a vertex deeper than this below a surface is named; also the most
                          // that the centre may be moved
};

struct AttitudeOutcome
{
  PoseTrack Poses;
  std::vector<Vec3> Shifts; // m, by which the centre was moved, one a frame; empty: not at all
  std::map<std::pair<int, int>, std::string> TooFast; // (Row, Target) of keys that no turning rate
                                                      // can meet, and why
  std::vector<RestTimes> Rests;
  std::vector<std::string> Warnings;
  // From each frame to the next:
  std::vector<unsigned char> Slowed; // the limit of turning acted
  std::vector<double> Swept;         // rad, all turning there and back in flight
};

/// The path's limit of turning holds for the flight; rows, rests and surfaces may turn poses by
/// more.
AttitudeOutcome TurnObject(const AttitudePlan& plan, const FlightBody& body,
                           const FlightPath& path);

} // namespace waft
