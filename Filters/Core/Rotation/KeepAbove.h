// SPDX-License-Identifier: BSD-3-Clause
// An object that has flown is kept above surfaces with all its mesh, from the first frame to the
// last.
#pragma once

#include "Rotation/Attitude.h"
#include "Rotation/Contact.h"
#include "Rotation/FloorContact.h"

#include <vector>

namespace waft
{

/// The surface nearest to the centre from a frame to the next, which are `step` seconds of the
/// body's turning apart; false when none is in reach. passing: the pose of a body that does not
/// land there, or none: its floor is the plane of PlaneBeside.
bool FindFloor(const AttitudePlan& plan, int frame, double step, const Quat* passing, Floor& floor);

/// What the flight has left of each frame.
struct FrameMarks
{
  explicit FrameMarks(std::size_t count) :
    Frames(count), Changed(count, 0), Held(count, 0), Landing(count, 0), Shifts(count, Vec3::Zero())
  {
  }

  std::vector<ContactFrame> Frames;   // how the pose may be changed
  std::vector<unsigned char> Changed; // the pose was turned after the flight
  std::vector<unsigned char> Held;    // rows hold the centre
  std::vector<unsigned char> Landing; // the shift is what the ground does: it stays
  std::vector<Vec3> Shifts;           // m, of the centre
  double Moved = 0.0;                 // m, at most, besides what its pose asks for where it lies
};

/// Other than ResolveClearance, which keeps the ball about a centre clear from frame to frame, this
/// lifts the vertices of a posed mesh over one surface a frame, after as much as it can turn; they
/// share how a move spreads over frames (SpreadPushes). Turns poses and, where that is not enough,
/// moves the centre, smoothly in time; marks both and warns of a centre that was moved and of a
/// mesh that lies below a surface all the same.
void KeepAbove(const AttitudePlan& plan, FrameMarks& marks, AttitudeOutcome& out);

} // namespace waft
