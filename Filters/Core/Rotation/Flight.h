// SPDX-License-Identifier: BSD-3-Clause
// One body turning in the air along a given path of its centre.
#pragma once

#include "Rotation/PanelBody.h"

#include <vector>

namespace waft
{

/// What the air does along the path, one sample a frame.
struct FlightPath
{
  double Step = 1.0 / 30.0;             // s between frames
  std::vector<Vec3> RelativeVelocities; // m/s, of the centre relative to the air, world
  std::vector<Mat3> AirGradients;       // 1/s, of the air's velocity, world; or empty
  /// rad/s, world: half the air's vorticity, at which a body turns that nothing but the stickiness
  /// of the air turns; damping draws to it. Empty: to rest.
  std::vector<Vec3> AirTurning;
};

/// A body with the constants of its motion.
class FlightBody
{
public:
  /// damping [1/s] turns the angular momentum down as exp(-damping t). follow [1/s]: how fast the
  /// hidden sideslip is forgotten.
  FlightBody(const PanelBody& panels, const ShellProperties& properties, double mass,
             double airDensity, const AirCoefficients& coefficients, double damping, double follow);

  const PanelBody* Panels;
  AirCoefficients Coefficients;
  double AirDensity;   // kg/m^3
  double Damping;      // 1/s
  double Follow;       // 1/s
  Mat3 Inertia;        // kg m^2, body axes, air that moves along included
  Mat3 InverseInertia; // 1/(kg m^2)
  Mat3 Mass;           // kg, body axes, air that moves along included
  Mat3 InverseMass;    // 1/kg
  double Mobility;     // 1/m: rate of damping per relative speed
  double Stiffness;    // 1/m: angular frequency per relative speed
  double Reach;        // m, root mean square distance of the area from the centre
  bool Slips;          // has a sideslip of its own
};

/// The body wants its z axis along Normal: what the cushion of air over a surface and the artist's
/// wish for a soft landing do together. Weight 0..1.
struct Settling
{
  Vec3 Normal = Vec3::UnitZ();
  double Weight = 0.0;
};

/// The state of a body, in world axes. A plate flies by a velocity of its own relative to the air:
/// it glides and overshoots about the path that draws it along. Without this hidden sideslip it
/// could not flutter or tumble, as its glide feeds both; only its turning is shown. All other
/// bodies move as the path does.
struct FlightState
{
  Quat Orientation = Quat::Identity();
  Vec3 AngularMomentum = Vec3::Zero(); // kg m^2/s
  Vec3 Momentum = Vec3::Zero();        // kg m/s, relative to the air, air that moves along included

  Vec3 AngularVelocity(const FlightBody& body) const;
  void SetAngularVelocity(const FlightBody& body, const Vec3& omega);
  /// Relative to the air [m/s]; only of bodies that slip.
  Vec3 Velocity(const FlightBody& body) const;
  void SetVelocity(const FlightBody& body, const Vec3& velocity);
};

struct Floor;

/// The air's torque [N m, world] at a frame.
Vec3 AirTorque(const FlightBody& body, const FlightPath& path, const FlightState& state,
               double frame);

/// Takes the state from a frame to the next one: midpoint steps on the rotation group, as many as
/// the fastest rate asks for; where even the most are too few the air's force is lessened. After
/// each step the floor (or none), as it is at the frame's beginning, stops what turned through it.
/// Returns whether it touched.
bool AdvanceFrame(const FlightBody& body, const FlightPath& path, int frame,
                  const Settling& settling, const Floor* floor, FlightState& state);

} // namespace waft
