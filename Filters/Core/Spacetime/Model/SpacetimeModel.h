// SPDX-License-Identifier: BSD-3-Clause
// The spacetime problem without units: lengths in gas spacings dx from the corner of the volume,
// times in frames. What is known and fixed while E is minimised.
#pragma once

#include "Constraints/ClearanceRule.h"
#include "Constraints/KeptDistances.h"
#include "Particles/ObstacleField.h"
#include "Particles/RestDensity.h"
#include "Particles/SphFluid.h"
#include "Spacetime/Model/AirFields.h"
#include "Spacetime/Model/GivenAir.h"
#include "Spacetime/Model/TermWeights.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace waft
{

/// Gas nearer to a wall or an obstacle is pushed off by a soft spring; none starts there [dx].
constexpr double SpringReach = 0.3;

/// Weights of Eq. 2 and Eq. 4, and of the terms beside them. E is half the weighted sum of squares
/// of residuals in dx and dx / frame.
struct SpacetimeWeights : TermWeights
{
  double Clearance = 10.0;      // objects nearer to a surface than they may be
  double Reach = 3.0;           // objects farther from their approach than they may be
  double Contact = 5.0;         // objects nearer to each other than ContactDistance
  double ContactDistance = 0.0; // d0 [dx]
  double Separation = 0.1;      // gas nearer to gas than GasDistance
  double GasDistance = 0.32;    // [dx]
  /// Of half the second difference of an object's control, over that of the control [frame^4].
  double Control = 0.0;
};

/// What holds for one object at one frame.
enum ObjectFrameFlags : std::uint8_t
{
  FixedPosition = 1,
  FixedVelocity = 2,
  NoDynamics = 4,       // the step into this frame is not one of free flight
  LandsOnFloor = 8,     // clearance to the floor is reduced to the rest height
  LandsOnObstacle = 16, // the same for obstacles
  LiftsOff = 32         // after a rest: no landing damping, which would hold it back
};

/// Everything but the unknowns.
struct SpacetimeModel
{
  SphFluid Fluid;
  SpacetimeWeights Weights;
  Vec3 Size = Vec3::Ones(); // of the gas' box [dx]
  int NumberOfFrames = 0;
  std::size_t NumberOfGas = 0;
  std::size_t NumberOfObjects = 0;
  std::vector<std::array<float, 3>> Offsets; // of an object's particles from its centre [dx]

  std::vector<float> Gravities;          // g' of each object, downwards [dx / frame^2]
  std::vector<float> DragRates;          // one an object [1 / frame]
  std::vector<ClearanceRule> Clearances; // one an object, in dx and in single precision
  std::vector<float> BrakeHeights;       // above rest, over which it is braked to land [dx]
  /// A place that an object should be near to at a frame, after its start and before it lands, and
  /// how near [dx]; Reach 0: none. Both [frame * NumberOfObjects + object].
  std::vector<Vec3> Approach;
  std::vector<float> Reach;
  /// What marks leave objects of ContactDistance [dx]; of no bodies: all of it.
  KeptDistances Kept{ 30.0 };
  /// How much of rs an object answers for at a frame, 0 to 1: less where it brakes, none where it
  /// lies still. Empty: all [frame * NumberOfObjects + object].
  std::vector<float> CoherenceFractions;
  std::vector<std::uint8_t> Flags; // [frame * NumberOfObjects + object]

  AirFields Fields;                        // that a run begins with
  std::array<int, 3> WindNodes{ 0, 0, 0 }; // of its lattice; zero: from Size
  double FieldRidge = 0.05;                // of vortices and wind (Paper/FieldPenalty.h)
  SplineWind Background;                   // the user's
  /// Where there is one, velocities are deviations from it in all of E but the positions' steps, no
  /// other field acts, and objects go with the air and settle in it: their DragRates are 1, their
  /// Gravities 0, and they do not feel the gas' pressure.
  GivenAir Air;
  float AirDrag = 0.0f; // with which the gas is drawn back to it [1 / frame]
  ObstacleField Obstacles;
  RestDensity
    Rest; // what the gas lattice lacks beside walls, and beside obstacles that stand still

  std::size_t NumberOfBodies() const { return this->NumberOfGas + this->NumberOfObjects; }
  std::size_t NumberOfParticles() const
  {
    return this->NumberOfGas + this->NumberOfObjects * this->Offsets.size();
  }
  /// Length of a component row of bodies: padded, so that rows are whole vectors.
  std::size_t Stride() const { return (this->NumberOfBodies() + 15) / 16 * 16; }
  /// Floats of one frame: x, y, z, u, v, w of all bodies.
  std::size_t FrameSize() const { return 6 * this->Stride(); }
  std::uint8_t Flag(int frame, std::size_t object) const
  {
    return this->Flags[static_cast<std::size_t>(frame) * this->NumberOfObjects + object];
  }
  float CoherenceFraction(int frame, std::size_t object) const
  {
    return this->CoherenceFractions.empty()
             ? 1.0f
             : this->CoherenceFractions[static_cast<std::size_t>(frame) * this->NumberOfObjects +
                                        object];
  }
  double BodyWeight(std::size_t body) const
  {
    return body < this->NumberOfGas ? 1.0 : static_cast<double>(this->Offsets.size());
  }
  /// How fast the air moves upwards about an object that settles freely [dx / frame]: there drag
  /// and effective gravity balance.
  float SettlingSlip(std::size_t object) const
  {
    const float rate = this->DragRates[object];
    return rate > 0.0f ? this->Gravities[object] / rate : 0.0f;
  }
  /// The weight of a body's velocity residual.
  double VelocityWeight(std::size_t body) const
  {
    return this->BodyWeight(body) * this->Weights.VelocityWeight;
  }
};

} // namespace waft
