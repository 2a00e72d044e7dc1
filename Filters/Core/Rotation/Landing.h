// SPDX-License-Identifier: BSD-3-Clause
// How a body comes to lie: it touches the ground as it is turned, tips over, rocks, and stands on
// three points of its own mesh.
#pragma once

#include "Rotation/Attitude.h"
#include "Rotation/FloorContact.h"
#include "Rotation/KeepAbove.h"
#include "Rotation/RestingPose.h"

namespace waft
{

/// The ground about one rest. The path brings the centre to the height at which a body lies with
/// its z axis up; by its pose it lies higher or lower, and as it tips over and rocks the ground
/// holds it above the path. All heights are above the plane that it lands on.
class Landing
{
public:
  /// held: rows hold the centre while it rests, so that nothing lifts it.
  Landing(const AttitudePlan& plan, const PlannedRest& rest, const Constraint* key, bool held);

  /// The last frame in which it may stir.
  int LastStirring() const { return this->End; }
  /// From here on the ground may lift it.
  bool IsNear(int frame) const { return frame >= this->First; }
  int FirstNear() const { return this->First; }

  /// What draws the body to a side that is asked for, or level where there is no ground.
  Settling Draw(int frame, const Quat& orientation) const;

  /// Sets what the floor may do to a body of this pose from a frame to the next, which are `step`
  /// seconds of its turning apart.
  void Support(int frame, const Quat& orientation, double step, Floor& floor) const;

  /// How it lies in the end, coming down like that.
  RestingPose Lay(const Quat& arriving) const;

  /// Out of the poses that are flown from a frame to LastStirring: turns the last of them to the
  /// one that stays, lifts the centre where the ground does, from frame `first` on, and says when
  /// it touched and settled. The frames from which it is still are the caller's.
  RestingPose Settle(int from, int first, FrameMarks& marks, AttitudeOutcome& out,
                     RestTimes& times) const;

private:
  /// How far above its path the centre is [m, upwards] as a body of this pose touches or flies.
  double Lift(int frame, const Quat& orientation) const;
  bool Touches(int frame, const Quat& orientation) const;
  double HeightOfPath(int frame) const;
  int StillFrom(const PoseTrack& poses, const Quat& lying) const;
  double Rise(int frame, const Quat& orientation) const;
  double Give(int frame) const;
  bool IsUp(const Quat& orientation) const;
  Quat Roll(const Quat& orientation) const;
  Quat Level(const Quat& orientation, double side) const;

  const AttitudePlan* Plan;
  const PlannedRest* Rest;
  const Constraint* Key; // a row within the rest chooses the heading
  bool Held;
  int First = 0;
  int End = 0;
  double RiseUp = 0.0;   // m, of the end of the path, where it lies with its z axis up
  double RiseDown = 0.0; // m, or down
};

} // namespace waft
