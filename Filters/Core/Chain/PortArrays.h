// SPDX-License-Identifier: BSD-3-Clause
// The arrays that the outputs of the stages have, in the words of ChainPort. Private to the table;
// the test of the pages holds them to those of a flight.
#pragma once

#include <string>

namespace waft
{

struct PortArrays
{
  const std::string Objects =
    "points: ObjectId int; ObjectIdGiven byte; ShapeId int; Mass double kg; Velocity double*3 m/s; "
    "VelocityGiven byte; Orientation double*4 w, x, y, z; OrientationGiven byte; "
    "AngularVelocity double*3 rad/s; SettlingSpeed double m/s; ClassId int; "
    "ClearanceRadius double m; RestHeight double m; Release int; "
    "Appears byte; LeaveFrom int; LeaveAway double*3; LeaveFade int; LeaveHasPlace int; LeavePlace "
    "double*3; On int; Arrival int; "
    "Leave int";
  const std::string Constraints =
    "points: ObjectId int; Frame int; Kind byte; Value double*4 of the kind; "
    "Radius double of the kind; Until int; Hold int; Drift int; HoldRadius double; LeaveFrom int; "
    "LeaveAway double*3; LeaveFade int; LeaveHasPlace int; LeavePlace double*3; On int; FrameFrom "
    "int; Arrival int; Release int; "
    "Leave int; "
    "TouchDown int; "
    "Settled int; "
    "LiftOff int; Row int; "
    "Target int; Group int; ClassId int; FaceUp byte; Facing double*3; FacingTolerance double rad; "
    "Choice byte; Status int";
  const std::string Obstacles = "points: ObstacleId int";
  const std::string Shapes =
    "points: TextureCoordinates float*2; "
    "whole: DragCoefficient double; AreaDensity double kg/m^2; Thickness double m; "
    "SettlingSpeed double m/s; Damping double 1/s; ClassId int; Color double*3 red, green, blue; "
    "Tint double*3 red, green, blue; Opacity double; Texture text";
  const std::string Vortices =
    "cells: VortexId int; Strength double m^2/s^2; CenterTime double s; Duration double s; "
    "CoreRadius double m; Confidence double; ObjectCount int";
  const std::string Wind = "points: Wind float*3 m/s^2";
  const std::string Air = "points: Velocity float*3 m/s; Wind float*3 m/s^2";
  const std::string Report = "rows: Row int; Target int; ObjectId int; Frame int; Kind text; "
                             "Residual double of the kind; Status text; Message text; "
                             "TouchDown int; Settled int; Arrival int; Release int; "
                             "Leave int";
  const std::string PlannedReport = Report + "; whole: TopSpeed double m/s";
  const std::string Trees = "cells: ObjectId int; Span int; Tree int; Parent int; Segment int; "
                            "Frame int; Cost double";
  const std::string Takes = "rows: Take int; Met int; Rows int; CurvatureDistance double; "
                            "AccelerationDistance double; Score double";
  const std::string Flights = "rows: ObjectId int; Row int; Target int; Frame int; Reached int; "
                              "RetimingFactor double; Cost double; Branches int; Seconds double s";
  const std::string ObjectReport =
    "rows: ObjectId int; Rows int; Met int; Status text; Cost double; Branches int; "
    "Seconds double s; Planned int; Message text";
  const std::string Rounds =
    "rows: Stage text; Candidate text; ControlRms double m/s; ControlMedian double m/s; "
    "FlowRms double m/s; WindRms double m/s; Seconds double s";
  const std::string Convergence =
    "rows: Pass int; Stage text; Iteration int; E double; Ex double; Ev double; Ec double; "
    "MaxViolation double m; Leash double m; Seconds double s; Clearance double; Approach double; "
    "Contact double; Separation double; Control double; EvObjects double; Fields double; E2 "
    "double; "
    "ShareVortices double; ShareWind double; ShareGas double; ShareDrag double; "
    "ShareLanding double; ShareNone double";
  const std::string Particles =
    "points: ParticleId int; Kind byte; ObjectId int; Mass float kg; Velocity float*3 m/s; "
    "Density float kg/m^3; Pressure float Pa; Wind float*3 m/s^2; VortexForce float*3 m/s^2; "
    "Residual float*3 m/s^2";

  // Tracks have more from stage to stage.
  const std::string Moved =
    "points: Frame int; Time double s; Velocity double*3 m/s; Present byte; "
    "ForceType byte; VortexId int; VortexAcceleration double*3 m/s^2; "
    "WindAcceleration double*3 m/s^2";
  const std::string Turned = "; Slip double*3 m/s; Orientation double*4 w, x, y, z; "
                             "AngularVelocity double*3 rad/s";
  const std::string OfLines = "; cells: ObjectId int; Release int; Leave int; Fade int; LoopTo int";
  const std::string Touched = "; TouchDown int; Settled int; Arrival int";
  const std::string Planned = Moved + OfLines;
  const std::string Drifted = Moved + "; AirVelocity double*3 m/s" + Turned +
                              "; Control double*3 m/s; Free byte" + OfLines + Touched;
  const std::string Solved = Moved +
                             "; Force double*3 m/s^2; AirVelocity double*3 m/s; "
                             "SPHVelocity double*3 m/s; Residual double*3 m/s^2" +
                             Turned;
  const std::string OfSolution =
    "; PositionResidual double dx; VelocityResidual double dx a frame" + Touched +
    "; whole: ReplayError double; GasReplayError double; GasHiddenHand double; "
    "RepairedFraction double; LargestRepair double m";
  const std::string Optimised = Solved + OfLines + OfSolution;
  const std::string Explained =
    Solved + "; VortexForce double*3 m/s^2; ResidualForce double*3 m/s^2" + OfLines + OfSolution;
  const std::string FittedVortices = Vortices + "; whole: Explained double";
  const std::string Poses =
    Solved + "; Torque double*3 N m" + OfLines +
    "; Shift double m; Agreement double*2 degrees; DragCoefficient double; Lift double; "
    "RotationalLift double; PressureShift double; Spin double rad; SlippingMass double kg; "
    "BroadsideSpeed double m/s; Damping double 1/s; Follow double 1/s; Pace double" +
    Touched + "; whole: Agreement double*2 degrees; TurningLimit double degrees a frame";
  const std::string Meshes =
    "points: ObjectId int; ShapeId int; Color byte*3 red, green, blue; TextureCoordinates float*2; "
    "Settled int; Normals float*3; Speed float m/s; cells: ObjectId int; ShapeId int; "
    "whole: Color double*3 red, green, blue; Tint double*3 red, green, blue; Opacity double; "
    "Texture text; Ground double m";
};

} // namespace waft
