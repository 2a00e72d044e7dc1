// SPDX-License-Identifier: BSD-3-Clause
// Objects of one kind at their starts, made by hand: one, a row, or many spread in a box.
#pragma once

#include "Base/Motion.h"
#include "Base/SceneFrame.h"
#include "Base/Shape.h"

#include <array>
#include <cstdint>
#include <vector>

namespace waft
{

enum class ObjectLayout
{
  One,
  Row,
  Spread
};

struct ObjectOptions : SceneFrame
{
  ObjectLayout Layout = ObjectLayout::One;
  int NumberOfObjects = 5;
  Vec3 Position{ 0.0, 0.0, 3.0 };
  Vec3 RowEnd{ 1.0, 0.0, 3.0 };
  Vec3 RegionMin{ -1.0, -1.0, 2.5 };
  Vec3 RegionSize{ 2.0, 2.0, 1.0 };
  std::uint64_t Seed = 1;
  Vec3 Velocity = Vec3::Zero();
  std::array<double, 4> Orientation{ 1.0, 0.0, 0.0, 0.0 }; // w, x, y, z; not zero
  Vec3 Angles = Vec3::Zero();                              // degrees
  Vec3 AngularVelocity = Vec3::Zero();
  int Release = -1;
  int LastRelease = -1;
  bool Appears = false;
  int On = -1;
  int ObjectId = -1;
  int ShapeId = 0;
  int ClassId = -1;
  double Mass = 0.001;
  double SettlingSpeed = 0.8;
  double ClearanceRadius = 0.05;
  double RestHeight = 0.0;
  double AirDensity = 1.2;
  bool OpenX = false;
  bool OpenY = false;
  bool OpenTop = false;
  bool Loop = false;

  SceneInfo Info() const
  {
    SceneInfo info = this->SceneFrame::Info();
    info.AirDensity = this->AirDensity;
    info.Open = { this->OpenX ? 1 : 0, this->OpenY ? 1 : 0, this->OpenTop ? 1 : 0 };
    info.Loops = this->Loop ? 1 : 0;
    return info;
  }

  /// Mass, settling speed, clearance, height at rest and class are those of a body.
  void TakeBodyOf(const Shape& shape);
  /// A velocity of zero is none: the object starts as its air does; so is the Orientation that is
  /// the default, without Angles: it starts turned as in flight. Objects without an ObjectId are
  /// numbered from 0. Fails where a spread finds no room.
  Result MakeObjects(std::vector<MotionObject>& objects) const;

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(OptionField{ "Layout",
                       { 0, 2 },
                       "",
                       "One object at Position, a row from Position to Row End, or a spread: "
                       "objects far from each other in the region." },
          of.Layout...);
    visit(OptionField{ "NumberOfObjects", limits::Count, "", "Objects of a row or a spread." },
          of.NumberOfObjects...);
    visit(OptionField{ "Position", limits::Coordinate, "m",
                       "Place of the centre of mass at frame 0, in metres." },
          of.Position...);
    visit(OptionField{ "RowEnd", limits::Coordinate, "m",
                       "Place of the last object of a row, in metres." },
          of.RowEnd...);
    visit(OptionField{ "RegionMin", limits::Coordinate, "m",
                       "Lowest corner of the region that a spread fills, in metres." },
          of.RegionMin...);
    visit(OptionField{ "RegionSize", limits::Distance, "m",
                       "Extents of the region that a spread fills, in metres." },
          of.RegionSize...);
    visit(SeedField(), of.Seed...);
    visit(OptionField{ "Velocity", limits::Velocity, "m/s",
                       "Velocity at frame 0, in metres per second." },
          of.Velocity...);
    visit(
      OptionField{ "Orientation",
                   limits::Direction,
                   "",
                   "Orientation at frame 0, a quaternion (w, x, y, z), body to world; 1, 0, 0, 0 "
                   "without Angles: none is given, objects start turned as in flight.",
                   { -1, 1 } },
      of.Orientation...);
    visit(OptionField{ "Angles",
                       limits::Direction,
                       "degrees",
                       "Turns about the world's x, y and z axes in this order, after Orientation, "
                       "in degrees.",
                       { -180, 180 } },
          of.Angles...);
    visit(OptionField{ "AngularVelocity", limits::Spin, "rad/s",
                       "Angular velocity at frame 0, in radians per second, world axes." },
          of.AngularVelocity...);
    visit(OptionField{ "Release",
                       { -1, limits::MostInt },
                       "",
                       "Frame until which an object hangs still at its start, of several the "
                       "first; -1: they fly from the first frame." },
          of.Release...);
    visit(OptionField{ "LastRelease",
                       { -1, limits::MostInt },
                       "",
                       "Of several objects, the last Release: they go one by one, by chance; -1: "
                       "all at Release." },
          of.LastRelease...);
    visit(FlagField("Appears", "An object is not in the shot before its Release, and begins in "
                               "flight."),
          of.Appears...);
    visit(
      OptionField{ "On",
                   { -1, limits::MostInt },
                   "",
                   "ObstacleId of the obstacle that the start goes along with until its Release; "
                   "-1: none." },
      of.On...);
    visit(OptionField{ "ObjectId",
                       { -1, limits::MostInt },
                       "",
                       "Number that tracks and constraints name the object by, of several the "
                       "first; -1: the least numbers that no other object takes." },
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
    visit(FlagField("OpenX", "Bodies and air pass both ends of the volume along x."), of.OpenX...);
    visit(FlagField("OpenY", "Bodies and air pass both ends of the volume along y."), of.OpenY...);
    visit(FlagField("OpenTop", "Bodies and air pass the top of the volume."), of.OpenTop...);
    visit(FlagField("Loop",
                    "The last frame leads on to the first: who is there at the end goes on to "
                    "where one of its shape begins."),
          of.Loop...);
    SceneFrame::Visit(visit, of...);
  }

private:
  Result MakeBody(MotionObject& object) const;
  Result MakePositions(std::vector<Vec3>& positions) const;
};

} // namespace waft
