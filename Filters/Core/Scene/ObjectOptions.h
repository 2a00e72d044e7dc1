// SPDX-License-Identifier: BSD-3-Clause
// One object at its start, made by hand.
#pragma once

#include "Base/Motion.h"
#include "Base/SceneFrame.h"

#include <array>

namespace waft
{

struct ObjectOptions : SceneFrame
{
  Vec3 Position{ 0.0, 0.0, 3.0 };
  Vec3 Velocity = Vec3::Zero();
  std::array<double, 4> Orientation{ 1.0, 0.0, 0.0, 0.0 }; // w, x, y, z; not zero
  Vec3 AngularVelocity = Vec3::Zero();
  int ObjectId = 0;
  int ShapeId = 0;
  int ClassId = -1;
  double Mass = 0.001;
  double SettlingSpeed = 0.8;
  double ClearanceRadius = 0.05;
  double RestHeight = 0.0;
  double AirDensity = 1.2;

  /// A velocity of zero is none: the object starts as its air does.
  Result MakeObject(MotionObject& object) const;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "Position", limits::Coordinate, "m",
                       "Place of the centre of mass at frame 0, in metres." },
          of.Position...);
    visit(OptionField{ "Velocity", limits::Velocity, "m/s",
                       "Velocity at frame 0, in metres per second." },
          of.Velocity...);
    visit(OptionField{ "Orientation",
                       limits::Direction,
                       "",
                       "Orientation at frame 0, a quaternion (w, x, y, z), body to world.",
                       { -1, 1 } },
          of.Orientation...);
    visit(OptionField{ "AngularVelocity", limits::Spin, "rad/s",
                       "Angular velocity at frame 0, in radians per second, world axes." },
          of.AngularVelocity...);
    visit(OptionField{ "ObjectId", limits::UpTo(limits::MostInt), "",
                       "Number that tracks and constraints name the object by." },
          of.ObjectId...);
    visit(OptionField{ "ShapeId", limits::UpTo(limits::MostInt), "",
                       "Block of Shapes that is its body." },
          of.ShapeId...);
    visit(OptionField{ "ClassId",
                       { -limits::MostInt - 1, limits::MostInt },
                       "",
                       "Class for targets that take one class only; -1: none.",
                       { -1, limits::MostInt } },
          of.ClassId...);
    visit(OptionField{ "Mass", limits::Mass, "kg", "Mass in kilograms; it serves the rotation." },
          of.Mass...);
    visit(OptionField{ "SettlingSpeed", limits::UpTo(limits::Speed.High), "m/s",
                       "Terminal fall speed in still air, in metres per second." },
          of.SettlingSpeed...);
    visit(OptionField{ "ClearanceRadius", limits::Distance, "m",
                       "Distance that the centre keeps from obstacles and walls, in metres: half "
                       "the body's largest extent." },
          of.ClearanceRadius...);
    visit(
      OptionField{ "RestHeight", limits::Distance, "m",
                   "Height of the centre of mass above a plane that the body lies on, in metres." },
      of.RestHeight...);
    visit(OptionField{ "AirDensity", limits::Density, "kg/m^3",
                       "Density of the air in kilograms per cubic metre." },
          of.AirDensity...);
    SceneFrame::Visit(visit, of...);
  }
};

} // namespace waft
