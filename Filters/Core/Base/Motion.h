// SPDX-License-Identifier: BSD-3-Clause
// Objects and their tracks: the data that stages pass on, as plain structures. What is wanted of
// them is in Constraints/Constraint.h, their VTK form in Filters/Bridge.
#pragma once

#include "Base/Leaving.h"
#include "Base/Mesh.h"
#include "Base/Types.h"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

namespace waft
{

/// What drove a traced or planned point (values of the array `ForceType`).
enum class ForceType : unsigned char
{
  None = 0,
  Wind = 1,
  Vortex = 2
};

/// One light object and its state at frame 0.
struct MotionObject
{
  int ObjectId = 0;
  int ShapeId = 0;
  int ClassId = -1;
  double Mass = 0.001; // kg
  Vec3 Position = Vec3::Zero();
  Vec3 Velocity = Vec3::Zero();
  int VelocityGiven = 0; // 1: an exact requirement; 0: it starts as its air does
  Quat Orientation = Quat::Identity();
  int OrientationGiven = 1;            // 0: it starts turned and turning as bodies in flight are
  Vec3 AngularVelocity = Vec3::Zero(); // rad/s, world
  double SettlingSpeed = 0.8;          // m/s, terminal fall speed in still air
  double ClearanceRadius = 0.05;       // m, half the largest extent
  double RestHeight = 0.0; // m, height of the centre of mass above a plane that the body lies on
  /// The frame until which it hangs still at its Position; -1: it flies from the first frame.
  int Release = -1;
  int Appears = 0; // 1: it is not in the shot before its Release, and begins in flight then
  Leaving Goes;    // though no row says so
  int On = -1;     // the obstacle with which its Position goes along until its Release; -1: none

  /// The frame from which it flies.
  int Released() const { return this->Release > 0 ? this->Release : 0; }
  /// It hangs still at first, and the air takes it from rest.
  bool Hangs() const { return this->Release > 0 && this->Appears == 0; }
  /// The first frame at which it is in the shot.
  int FirstPresent() const { return this->Appears != 0 ? this->Released() : 0; }

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.ObjectId...);
    visit(of.ShapeId...);
    visit(of.ClassId...);
    visit(of.Mass...);
    visit(of.Position...);
    visit(of.Velocity...);
    visit(of.VelocityGiven...);
    visit(of.Orientation...);
    visit(of.OrientationGiven...);
    visit(of.AngularVelocity...);
    visit(of.SettlingSpeed...);
    visit(of.ClearanceRadius...);
    visit(of.RestHeight...);
    visit(of.Release...);
    visit(of.Appears...);
    visit(of.Goes...);
    visit(of.On...);
  }
};

/// The path of one object, one sample a frame from frame 0. Optional lists are empty or as long as
/// Positions.
struct Track
{
  int ObjectId = 0;
  int Release = -1;                      // of the object
  int FirstPresent = 0;                  // frame from which it is in the shot; still before
  int Leave = -1;                        // frame from which it is gone; still from there on
  int Fade = 0;                          // frames before Leave in which it fades
  int LoopTo = -1;                       // the object as which it begins anew; -1: none
  std::vector<Vec3> Positions;           // m
  std::vector<Vec3> SphVelocities;       // m/s, the optimiser's raw unknown
  std::vector<ForceType> ForceTypes;     // annotation
  std::vector<int> VortexIds;            // -1: none
  std::vector<Vec3> VortexAccelerations; // m/s^2
  std::vector<Vec3> WindAccelerations;   // m/s^2
  std::vector<Vec3> Forces;              // m/s^2, vortex plus wind, after the optimiser
  std::vector<Vec3> AirVelocities;       // m/s, of the gas at the object
  std::vector<Vec3> Residuals;           // m/s^2, what no term of the optimiser's model gives
  /// m/s, the body's own velocity relative to the air, by its pose: it glides. Empty: it sinks
  /// straight down at its SettlingSpeed. The next two are the poses that Slips belongs to.
  std::vector<Vec3> Slips;
  std::vector<Quat> Orientations;      // body to world, unit
  std::vector<Vec3> AngularVelocities; // rad/s, world

  bool IsPresent(std::size_t frame) const
  {
    const auto at = static_cast<int>(frame);
    return at >= this->FirstPresent && (this->Leave < 0 || at < this->Leave);
  }
  /// Of its own, 0 to 1, at which it is shown.
  double SizeAt(std::size_t frame) const
  {
    const bool fades = this->Leave >= 0 && this->Fade > 0;
    return !this->IsPresent(frame) ? 0.0
           : fades ? std::min(1.0, (this->Leave - static_cast<double>(frame)) / this->Fade)
                   : 1.0;
  }
  bool ComesOrGoes() const { return this->FirstPresent > 0 || this->Leave >= 0; }
  /// The frame after the last one at which it is in the shot.
  std::size_t EndPresent() const
  {
    return this->Leave < 0 ? this->Positions.size() : static_cast<std::size_t>(this->Leave);
  }
  /// Who it is of, and when that is where.
  void TakeTimes(const MotionObject& object)
  {
    this->ObjectId = object.ObjectId;
    this->Release = object.Release;
    this->FirstPresent = object.FirstPresent();
  }

  template <class Visitor, class... Holder>
  static void Visit(Visitor&& visit, Holder&... of)
  {
    visit(of.ObjectId...);
    visit(of.Release...);
    visit(of.FirstPresent...);
    visit(of.Leave...);
    visit(of.Fade...);
    visit(of.LoopTo...);
    visit(of.Positions...);
    visit(of.SphVelocities...);
    visit(of.ForceTypes...);
    visit(of.VortexIds...);
    visit(of.VortexAccelerations...);
    visit(of.WindAccelerations...);
    visit(of.Forces...);
    visit(of.AirVelocities...);
    visit(of.Residuals...);
    visit(of.Slips...);
    visit(of.Orientations...);
    visit(of.AngularVelocities...);
  }
};

/// Central differences of samples, a second, one-sided and of second order at the ends; zero for
/// a single one. step: time between samples [s]. first, end: where they begin and end, by default
/// all; zero beside.
std::vector<Vec3> CentralDifferences(const std::vector<Vec3>& samples, double step,
                                     std::size_t first = 0,
                                     std::size_t end = std::numeric_limits<std::size_t>::max());
/// Of the positions [m/s], where the object is in the shot.
std::vector<Vec3> CentralVelocities(const Track& track, double step);

} // namespace waft
