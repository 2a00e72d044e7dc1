// SPDX-License-Identifier: BSD-3-Clause
// Objects, their tracks, the artist's constraints and the report about them: the data that stages
// pass on, as plain structures. Their VTK form is in Filters/Bridge.
#pragma once

#include "Base/Mesh.h"
#include "Base/Types.h"

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
  Quat Orientation = Quat::Identity();
  Vec3 AngularVelocity = Vec3::Zero(); // rad/s, world
  double SettlingSpeed = 0.8;          // m/s, terminal fall speed in still air
  double ClearanceRadius = 0.05;       // m, half the largest extent
  double RestHeight = 0.0; // m, height of the centre of mass above a plane that the body lies on
};

/// The path of one object, one sample a frame from frame 0. Optional lists are empty or as long as
/// Positions.
struct Track
{
  int ObjectId = 0;
  std::vector<Vec3> Positions;           // m
  std::vector<Vec3> SphVelocities;       // m/s, the optimiser's raw unknown
  std::vector<ForceType> ForceTypes;     // annotation
  std::vector<int> VortexIds;            // -1: none
  std::vector<Vec3> VortexAccelerations; // m/s^2
  std::vector<Vec3> WindAccelerations;   // m/s^2
  std::vector<Vec3> Forces;              // m/s^2, vortex plus wind, after the optimiser
  std::vector<Vec3> AirVelocities;       // m/s, of the gas at the object
};

/// Central differences of the positions [m/s], one-sided and of second order at the ends; zero for
/// a single sample. step: time between samples [s].
std::vector<Vec3> CentralVelocities(const std::vector<Vec3>& positions, double step);

/// Values of the array `Kind`.
enum class ConstraintKind : unsigned char
{
  Position = 0,
  Velocity = 1,
  Acceleration = 2,
  Orientation = 3,
  Rest = 4
};

/// "position", "velocity", "acceleration", "orientation", "rest".
const char* ToString(ConstraintKind kind);

enum class ConstraintStatus
{
  Met,
  Infeasible, // by itself: inside an obstacle or outside the volume
  Conflict,   // with another row, named
  Unreachable // no path found in the limits; the path comes as near as it could
};

/// "met", "infeasible", "conflict", "unreachable".
const char* ToString(ConstraintStatus status);

/// One wish about one object at one frame.
struct Constraint
{
  int ObjectId = -1; // -1: any object, assigned by the planner
  int Frame = 0;
  ConstraintKind Kind = ConstraintKind::Position;
  Vec3 Value = Vec3::Zero();           // m, m/s or m/s^2; for rest the point above the surface
  Quat Orientation = Quat::Identity(); // of an orientation row
  double Radius = 0.0;                 // same unit as Value (orientation: rad); 0: exact
  int Until = 0;                       // rest lasts from Frame to this frame
  int Row = 0;                         // place in the scene's list
  int Target = 0;                      // place in that row's list of targets
  int Group = -1;                      // rows of one group go to distinct objects
  int ClassId = -1;                    // -1: any
  ConstraintStatus Status =
    ConstraintStatus::Met; // what an earlier stage found: only met rows bind
};

/// One line of the Report, one per (Row, Target).
struct ReportRow
{
  int Row = 0;
  int Target = 0;
  int ObjectId = -1;
  int Frame = 0;
  ConstraintKind Kind = ConstraintKind::Position;
  double Residual = 0.0; // distance beyond Radius, in the unit of Value
  ConstraintStatus Status = ConstraintStatus::Met;
  std::string Message;
};

} // namespace waft
