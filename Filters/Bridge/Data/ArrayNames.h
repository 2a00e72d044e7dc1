// SPDX-License-Identifier: BSD-3-Clause
// Every array and block name that stages pass on, once.
#pragma once

namespace waft
{
namespace names
{

// Field data of every output.
constexpr const char* Bounds = "Bounds";
constexpr const char* NumberOfFrames = "NumberOfFrames";
constexpr const char* FramesPerSecond = "FramesPerSecond";
constexpr const char* AirDensity = "AirDensity";
constexpr const char* Seed = "Seed";

// Field data of what a stage shows before its work is done: 0.
constexpr const char* Complete = "Complete";

// Field data of what a scene file made: its part of the file.
constexpr const char* Authored = "Authored";

// Tracks and poses.
constexpr const char* Frame = "Frame";
constexpr const char* Time = "Time";
constexpr const char* Velocity = "Velocity";
constexpr const char* Explained = "Explained";
constexpr const char* ExplainedLeftOut = "ExplainedLeftOut";
constexpr const char* ForceType = "ForceType";
constexpr const char* VortexId = "VortexId";
constexpr const char* VortexAcceleration = "VortexAcceleration";
constexpr const char* WindAcceleration = "WindAcceleration";
constexpr const char* Force = "Force";
constexpr const char* AirVelocity = "AirVelocity";
constexpr const char* Control = "Control"; // of assimilated tracks
constexpr const char* Free = "Free";       // likewise
constexpr const char* ResponseTime = "ResponseTime";
constexpr const char* SPHVelocity = "SPHVelocity";
constexpr const char* ObjectId = "ObjectId";
constexpr const char* Orientation = "Orientation";
constexpr const char* AngularVelocity = "AngularVelocity";
constexpr const char* Torque = "Torque";
constexpr const char* ResidualForce = "ResidualForce";

// Objects.
constexpr const char* ShapeId = "ShapeId";
constexpr const char* Mass = "Mass";
constexpr const char* SettlingSpeed = "SettlingSpeed";
constexpr const char* ObjectIdGiven = "ObjectIdGiven";
constexpr const char* VelocityGiven = "VelocityGiven";
constexpr const char* OrientationGiven = "OrientationGiven";
constexpr const char* ClassId = "ClassId";
constexpr const char* ClearanceRadius = "ClearanceRadius";
constexpr const char* RestHeight = "RestHeight";

// Poses (of each line).
constexpr const char* Shift = "Shift";
constexpr const char* Agreement = "Agreement";       // degrees; of all bodies as field data
constexpr const char* TurningLimit = "TurningLimit"; // degrees a frame; of all bodies
constexpr const char* Slip = "Slip";                 // m/s, of a body relative to the air
// What each turns and glides by, besides its shape's DragCoefficient and Damping, which vary, too.
constexpr const char* Lift = "Lift";
constexpr const char* RotationalLift = "RotationalLift";
constexpr const char* PressureShift = "PressureShift"; // in half chords
constexpr const char* Spin = "Spin";                   // rad
constexpr const char* SlippingMass = "SlippingMass";
constexpr const char* BroadsideSpeed = "BroadsideSpeed"; // m/s
constexpr const char* Follow = "Follow";                 // 1/s
constexpr const char* Pace = "Pace";

// Meshes: of each body as it flies, and of the ground under all (field data).
constexpr const char* Speed = "Speed";
constexpr const char* Ground = "Ground";

// Shapes (field data of each block).
constexpr const char* DragCoefficient = "DragCoefficient";
constexpr const char* AreaDensity = "AreaDensity";
constexpr const char* Thickness = "Thickness";
constexpr const char* Damping = "Damping"; // 1/s
constexpr const char* Texture = "Texture";
constexpr const char* Skin = "Skin";         // bytes of PNG files, one after the other
constexpr const char* SkinSize = "SkinSize"; // how many of them each shape has
constexpr const char* Color = "Color";
constexpr const char* Tint = "Tint"; // of the texture
constexpr const char* Opacity = "Opacity";

// Constraints and report.
constexpr const char* Kind = "Kind";
constexpr const char* Value = "Value";
constexpr const char* Radius = "Radius";
constexpr const char* Until = "Until";
constexpr const char* Hold = "Hold";                   // frames that it stays after all have come
constexpr const char* Drift = "Drift";                 // 1: its form drifts then
constexpr const char* HoldRadius = "HoldRadius";       // m, of its place in it; 0: its length
constexpr const char* FrameFrom = "FrameFrom";         // of a window; -1: none
constexpr const char* Release = "Release";             // -1: it flies from the first frame
constexpr const char* LeaveFrom = "LeaveFrom";         // frame from which it goes; -1: it does not
constexpr const char* LeaveAway = "LeaveAway";         // the way out; zero: it goes where it is
constexpr const char* LeaveFade = "LeaveFade";         // frames
constexpr const char* LeaveHasPlace = "LeaveHasPlace"; // 1: it goes to LeavePlace
constexpr const char* LeavePlace = "LeavePlace";
constexpr const char* Fade = "Fade";
constexpr const char* Open = "Open";       // 1: bodies and air pass the ends of x, of y, the top
constexpr const char* Breeze = "Breeze";   // m/s, through open sides
constexpr const char* Loops = "Loops";     // 1: the last frame leads on to the first
constexpr const char* LoopTo = "LoopTo";   // ObjectId of the one as which it begins anew; -1: none
constexpr const char* Leave = "Leave";     // frame from which it is gone; -1: it stays
constexpr const char* Appears = "Appears"; // 1: in the shot from its Release on
constexpr const char* Present = "Present"; // by frame; 0: it is not in the shot
constexpr const char* On = "On";           // the obstacle that it goes along with; -1: none
constexpr const char* Arrival = "Arrival"; // -1: not chosen yet, or no row
constexpr const char* Row = "Row";
constexpr const char* Target = "Target";
constexpr const char* Group = "Group";
constexpr const char* Residual = "Residual";
constexpr const char* Status = "Status";
constexpr const char* Message = "Message";

// What is found in a scene.
constexpr const char* Possible = "Possible";
constexpr const char* Text = "Text";
constexpr const char* Place = "Place";
constexpr const char* Lines = "Lines";
constexpr const char* NumberOfObjects = "NumberOfObjects";
constexpr const char* NumberOfConstraints = "NumberOfConstraints";

// Obstacles.
constexpr const char* ObstacleId = "ObstacleId";

// Vortices.
constexpr const char* Strength = "Strength";
constexpr const char* CenterTime = "CenterTime";
constexpr const char* Duration = "Duration";
constexpr const char* CoreRadius = "CoreRadius";
constexpr const char* Confidence = "Confidence";
constexpr const char* ObjectCount = "ObjectCount";

// Wind and smoke fields.
constexpr const char* Wind = "Wind";
constexpr const char* Density = "Density";
constexpr const char* Pressure = "Pressure";
constexpr const char* Vorticity = "Vorticity";
constexpr const char* VortexForce = "VortexForce";
constexpr const char* WindForce = "WindForce";
constexpr const char* Obstacle = "Obstacle";

// Motion database: its blocks, and their arrays that are not named above.
constexpr const char* Segments = "Segments";
constexpr const char* Basis = "Basis"; // the block and its array
constexpr const char* Nodes = "Nodes";
constexpr const char* Connections = "Connections";
constexpr const char* Vortices = "Vortices";
constexpr const char* Provenance = "Provenance";
constexpr const char* Window = "Window";
constexpr const char* TopSpeed = "TopSpeed";
constexpr const char* Simulation = "Simulation";
constexpr const char* Coefficients = "Coefficients";
constexpr const char* MeanWind = "MeanWind";
constexpr const char* Mean = "Mean";
constexpr const char* Rank = "Rank";
constexpr const char* RelativeError = "RelativeError";
constexpr const char* Parent = "Parent";
constexpr const char* Medoid = "Medoid";
constexpr const char* FirstChild = "FirstChild";
constexpr const char* NumberOfChildren = "NumberOfChildren";
constexpr const char* NumberOfSegments = "NumberOfSegments";
constexpr const char* Before = "Before";
constexpr const char* After = "After";
constexpr const char* Cost = "Cost";
constexpr const char* IsConnectible = "IsConnectible";
constexpr const char* Rotation = "Rotation";
constexpr const char* Translation = "Translation";
constexpr const char* Key = "Key";

// Coverage of a motion database.
constexpr const char* Simulations = "Simulations";
constexpr const char* NewSegments = "NewSegments";
constexpr const char* NewShare = "NewShare";

// Planning trees, and their arrays that are not named above.
constexpr const char* Span = "Span";
constexpr const char* Tree = "Tree";
constexpr const char* Segment = "Segment";

// Flights and objects of a plan, and their columns that are not named above.
constexpr const char* Reached = "Reached";
constexpr const char* RetimingFactor = "RetimingFactor";
constexpr const char* Branches = "Branches";
constexpr const char* Planned = "Planned";

// Takes.
constexpr const char* Take = "Take";
constexpr const char* Met = "Met";
constexpr const char* Rows = "Rows";
constexpr const char* CurvatureDistance = "CurvatureDistance";
constexpr const char* AccelerationDistance = "AccelerationDistance";
constexpr const char* Score = "Score";

// Particles.
constexpr const char* ParticleId = "ParticleId";

// Tables of what was done.
constexpr const char* Stage = "Stage";
constexpr const char* Seconds = "Seconds";
constexpr const char* TouchDown = "TouchDown"; // of rests
constexpr const char* Settled = "Settled";     // likewise
constexpr const char* FaceUp = "FaceUp";       // likewise
constexpr const char* Facing = "Facing";       // of positions
constexpr const char* FacingTolerance = "FacingTolerance";
constexpr const char* Choice = "Choice";   // of constraints: how they came by their objects
constexpr const char* LiftOff = "LiftOff"; // of rests
constexpr const char* LandingHeight = "LandingHeight"; // likewise, of marks beside a motion
constexpr const char* Candidate = "Candidate";         // of rounds
constexpr const char* ControlRms = "ControlRms";
constexpr const char* ControlMedian = "ControlMedian";
constexpr const char* FlowRms = "FlowRms";
constexpr const char* WindRms = "WindRms";
constexpr const char* PositionResidual = "PositionResidual"; // of tracks
constexpr const char* VelocityResidual = "VelocityResidual";
constexpr const char* ReplayError = "ReplayError"; // of tracks, field data
constexpr const char* GasReplayError = "GasReplayError";
constexpr const char* GasHiddenHand = "GasHiddenHand";
constexpr const char* RepairedFraction = "RepairedFraction";
constexpr const char* LargestRepair = "LargestRepair";
constexpr const char* ForceSquares = "ForceSquares";
constexpr const char* VorticesPart = "VorticesPart";
constexpr const char* FieldsExplained = "FieldsExplained";

} // namespace names
} // namespace waft
