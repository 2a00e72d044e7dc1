// SPDX-License-Identifier: BSD-3-Clause
// Constraints on one object, made by hand.
#pragma once

#include "Base/SceneFrame.h"
#include "Constraints/Constraint.h"
#include "Scene/FacingOptions.h"

#include <array>
#include <vector>

namespace waft
{

struct ConstraintOptions
  : SceneFrame
  , FacingOptions
{
  int ObjectId = 0;
  ConstraintKind Kind = ConstraintKind::Position;
  int Frame = 150;
  int FrameFrom = -1;
  int Hold = 0;
  bool Drift = false;
  int On = -1;
  int LastFrame = -1;
  int Until = -1;
  Vec3 Value{ 0.0, 0.0, 2.0 };
  std::array<double, 4> Orientation{ 1.0, 0.0, 0.0, 0.0 }; // w, x, y, z
  double Radius = 0.0;
  bool UseWaypoints = false;
  std::vector<std::array<double, 3>> Waypoints{ { -0.5, 0.0, 2.0 }, { 0.5, 0.0, 2.0 } };

  /// One row at Frame, or one at each of the waypoints, at frames evenly spaced from Frame to
  /// LastFrame. Row is -1.
  Result MakeRows(std::vector<Constraint>& rows) const;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "ObjectId",
                       { -1, limits::MostInt },
                       "",
                       "The object spoken of; -1: any, the planner chooses." },
          of.ObjectId...);
    visit(OptionField{ "Kind",
                       { 0, NumberOfConstraintKinds - 1 },
                       "",
                       "What is wanted. Rest: it lies still on the first surface straight below." },
          of.Kind...);
    visit(OptionField{ "Frame", limits::UpTo(limits::MostInt), "",
                       "Frame of the constraint, or of the first waypoint." },
          of.Frame...);
    visit(OptionField{ "FrameFrom",
                       { -1, limits::MostInt },
                       "",
                       "First frame of a window that ends at Frame: the object comes at the frame "
                       "of least control; -1: at Frame." },
          of.FrameFrom...);
    visit(OptionField{ "Hold", limits::UpTo(limits::MostInt), "",
                       "Frames for which it stays there, still; not of rests." },
          of.Hold...);
    visit(FlagField("Drift",
                    "What is held drifts as one form, and each object stays near its place "
                    "in it."),
          of.Drift...);
    visit(
      OptionField{ "On",
                   { -1, limits::MostInt },
                   "",
                   "ObstacleId of the obstacle that a position or rest goes along with from its "
                   "frame on; -1: none." },
      of.On...);
    visit(OptionField{ "LastFrame",
                       { -1, limits::MostInt },
                       "",
                       "Frame of the last waypoint; -1 is the last of the scene." },
          of.LastFrame...);
    visit(OptionField{ "Until",
                       { -1, limits::MostInt },
                       "",
                       "A rest lasts to this frame; -1 is the last of the scene." },
          of.Until...);
    visit(OptionField{ "Value", limits::Coordinate, "",
                       "Place in metres (of a rest the point above the surface), velocity in "
                       "metres per second or acceleration in metres per second squared." },
          of.Value...);
    visit(OptionField{ "Orientation",
                       limits::Direction,
                       "",
                       "Orientation wanted, a quaternion (w, x, y, z), body to world.",
                       { -1, 1 } },
          of.Orientation...);
    visit(OptionField{ "Radius", limits::Distance, "",
                       "By how much it may be missed, in the unit of its value (orientation: "
                       "radians); 0 is exact." },
          of.Radius...);
    visit(FlagField("UseWaypoints", "Several places, a way through them, instead of Value."),
          of.UseWaypoints...);
    visit(OptionField{ "Waypoints", limits::Coordinate, "m",
                       "Places instead of Value, in the order of time, in metres." },
          of.Waypoints...);
    FacingOptions::Visit(visit, of...);
    SceneFrame::Visit(visit, of...);
  }

private:
  Result CheckFrames(int count) const;
  Result TakeTimes(const ConstraintTraits& kind, Constraint& row) const;
};

} // namespace waft
