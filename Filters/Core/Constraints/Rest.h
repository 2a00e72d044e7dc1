// SPDX-License-Identifier: BSD-3-Clause
// Where things come to rest, and what clearance holds around a landing: the one rule that planner,
// optimiser and rotation ask.
#pragma once

#include "Base/Motion.h"
#include "Constraints/ClearanceRule.h"
#include "Constraints/Constraint.h"
#include "Obstacles/ObstacleSet.h"

#include <limits>
#include <vector>

namespace waft
{

/// [s] in which a thing that settles is braked to rest, as on a cushion of air.
constexpr double CushionTime = 1.0 / 3.0;
/// [m] by which a resting centre may miss its distance, for rounding.
constexpr double LandingSlack = 1e-6;

/// The centre of a body that lies on the first surface straight below `value` at a frame: x and y
/// are the value's, the height is the surface's plus restHeight / normal.z, so that a body lying in
/// the tangent plane touches it (on faces steeper than 84 degrees as if they were 84). False when
/// there is nothing below.
bool RestingPosition(const ObstacleSet& obstacles, const Vec3& value, double frame,
                     double restHeight, Vec3& centre, SurfaceHit& hit);

/// Where a row of a positional kind asks the centre of an object to be from Frame to
/// LastFrame(row): a rest goes along with what it lies on, which points into `obstacles`. False
/// when it asks for no position: a rest with nothing below, or another kind.
bool WantedPlace(const Constraint& row, double restHeight, const ObstacleSet& obstacles,
                 CarriedPlace& place);
/// Value of a position or rest at another frame than Frame.
Vec3 ValueAt(const Constraint& row, int frame, const ObstacleSet& obstacles);
/// Where an object is until it is released.
CarriedPlace StartPlace(const MotionObject& object, const ObstacleSet& obstacles);

/// One rest row and the time around it in which its surface does not count as an obstacle: from one
/// second before it lies there to one second after its Until.
struct LandingWindow
{
  int ObstacleId = -1;         // the surface landed on
  int Frame = 0;               // FirstFrame of the row
  int Until = 0;               // LastFrame of the row
  double First = 0.0;          // frames
  double Last = 0.0;           // frames
  CarriedPlace Centre;         // resting position of the centre
  CarriedPlace Point;          // of the surface, straight below
  Vec3 Normal = Vec3::UnitZ(); // of the surface there
  double Room = 1e30;          // m, from the centre to the nearest other surface
  double Least = 1e30; // m, that the centre keeps from the surface where that is below RestHeight
  int Row = 0;
  int Target = 0;
};

/// In which a body sinks from its clearance radius to lie: at half its settling speed, 0.2 s at
/// least, a second at most. What comes in a window of frames keeps clear of its surface till then,
/// in the air, so that it touches about the frame that it was given.
double SinkingFrames(const MotionObject& object, double framesPerSecond);

/// The windows of one object in order of Frame. rows: constraints of the scene; those of other
/// objects, of other kinds, and rests with nothing below are passed over.
std::vector<LandingWindow> LandingWindows(const MotionObject& object,
                                          const std::vector<Constraint>& rows,
                                          const ObstacleSet& obstacles, double framesPerSecond);

/// The same of an object that hangs within its clearance of an obstacle: until one second after its
/// release it keeps no more from that than it has there. False where it hangs free.
bool HangingWindow(const MotionObject& object, const ObstacleSet& obstacles, double framesPerSecond,
                   LandingWindow& window);

/// What holds for the centre of an object at one frame.
struct Clearance
{
  /// m, to every obstacle but the exempt one, to sides and top; around a rest no more than the rest
  /// itself leaves.
  double Radius = 0.0;
  int Exempt = -1;              // the obstacle it lands on or leaves, -1: none
  double LandingDistance = 0.0; // m, least signed distance to the exempt obstacle: the RestHeight
};

Clearance RequiredClearance(const ClearanceRule& rule, const std::vector<LandingWindow>& windows,
                            double frame);

/// Swept version: from a at frameA to b at frameB, frameA <= frameB, split where a window begins or
/// ends. Within a window the centre keeps its LandingDistance (less LandingSlack) from the
/// exempt obstacle, looked at in at least 8 points a frame. Walls are not looked at.
bool IsMotionClear(const ObstacleSet& obstacles, const ClearanceRule& rule,
                   const std::vector<LandingWindow>& windows, const Vec3& a, double frameA,
                   const Vec3& b, double frameB);

/// Where a body may be, frame by frame.
struct FlightRoom
{
  Box Volume;
  Box Beyond;                                     // without the open sides
  int OpenFrom = std::numeric_limits<int>::max(); // frame from which it may pass those

  FlightRoom(const Box& volume) : Volume(volume), Beyond(volume) {}
  FlightRoom(const SceneInfo& scene, int openFrom) :
    Volume(scene.Bounds), Beyond(scene.Beyond()), OpenFrom(openFrom)
  {
  }
  const Box& At(double frame) const { return frame < this->OpenFrom ? this->Volume : this->Beyond; }
};

/// True when x keeps the clearance's radius from the sides and the top of the volume and from its
/// floor; during a landing LandingDistance (less LandingSlack) is enough from the floor.
bool KeepsInside(const Box& volume, const Clearance& clearance, const Vec3& x);

} // namespace waft
