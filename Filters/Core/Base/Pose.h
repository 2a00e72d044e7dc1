// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Base/Types.h"

#include <vector>

namespace waft
{

/// How one object turns: one sample a frame from frame 0, beside the positions of its Track.
struct PoseTrack
{
  int ObjectId = 0;
  std::vector<Quat> Orientations;      // body to world, unit, no sign flip between frames
  std::vector<Vec3> AngularVelocities; // rad/s, world
  std::vector<Vec3> Torques;           // N m, world, of the air
  std::vector<Vec3> Slips;             // m/s, world, its velocity relative to the air; or empty

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.ObjectId...);
    visit(of.Orientations...);
    visit(of.AngularVelocities...);
    visit(of.Torques...);
    visit(of.Slips...);
  }
};

/// The numbers of its own by which a body turns and glides: no two of a shape are alike.
struct BodyFactors
{
  double Drag = 0.0;           // cd, broadside
  double Lift = 0.0;           // extra slope of the normal force at small angles of attack
  double RotationalLift = 0.0; // C_R, of the circulation of a turning plate
  double PressureShift = 0.0;  // centre of pressure edge-on, in half chords ahead of the centre
  double Spin = 0.0;           // rad, pitch about its normal
  double SlippingMass = 0.0;   // kg, that moves relative to the air, without the air's own
  double BroadsideSpeed = 0.0; // m/s, where its drag is its weight; 0: its path draws it
  double Damping = 0.0;        // 1/s, of its turning
  double Follow = 0.0;         // 1/s, at which its sideslip is forgotten
  double Pace = 1.0;           // seconds of its turning in a second
};

} // namespace waft
