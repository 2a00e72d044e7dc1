// SPDX-License-Identifier: BSD-3-Clause
// One body turning in the air along a given path of its centre.
#pragma once

#include "Rotation/PanelBody.h"

#include <limits>
#include <vector>

namespace waft
{

/// Turning above a rate dies away to it.
struct TurningEase
{
  double Above = std::numeric_limits<double>::infinity(); // rad/s
  double Rate = 0.0;                                      // 1/s, of what is above
};

/// What the air does along the path, one sample a frame.
struct FlightPath
{
  /// s between frames, of the turning: a body that is turned as a larger one of the same form is,
  /// in like proportion more slowly, has shorter ones.
  double Step = 1.0 / 30.0;
  std::vector<Vec3> RelativeVelocities; // m/s, of the centre relative to the air, world
  std::vector<Mat3> AirGradients;       // 1/s, of the air's velocity, world; or empty
  /// rad/s, world: half the air's vorticity, at which a body turns that nothing but the stickiness
  /// of the air turns; damping draws to it. Empty: to rest.
  std::vector<Vec3> AirTurning;
  TurningEase Ease; // of its turning's seconds
  std::vector<double>
    FastestTurning; // rad/s, from each frame to the next, or infinite; or empty: no limits
  double QuickestChange =
    0.0; // rad/s^2, of the angular velocity by torques; where the former is finite
};

/// A body with the constants of its motion.
class FlightBody
{
public:
  /// damping [1/s] turns the angular momentum down as exp(-damping t). follow [1/s]: how fast the
  /// sideslip is forgotten. moved [kg]: the mass that slips, where it is another one than the mass
  /// that turns.
  FlightBody(const PanelBody& panels, const ShellProperties& properties, double mass,
             double airDensity, const AirCoefficients& coefficients, double damping, double follow);
  FlightBody(const PanelBody& panels, const ShellProperties& properties, double mass, double moved,
             double airDensity, const AirCoefficients& coefficients, double damping, double follow);

  const PanelBody* Panels;
  AirCoefficients Coefficients;
  double AirDensity;     // kg/m^3
  double Damping;        // 1/s
  double Follow;         // 1/s
  Mat3 Inertia;          // kg m^2, body axes, air that moves along included
  Mat3 InverseInertia;   // 1/(kg m^2)
  Vec3 PrincipalInertia; // kg m^2, of the columns of PrincipalAxes
  Mat3 PrincipalAxes;    // body axes
  Mat3 Mass;             // kg, body axes, air that moves along included
  Mat3 InverseMass;      // 1/kg
  double Mobility;       // 1/m: rate of damping per relative speed
  double Stiffness;      // 1/m: angular frequency per relative speed
  double Reach;          // m, root mean square distance of the area from the centre
  bool Slips;            // has a sideslip of its own
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

/// An angular velocity above `fastest` [rad/s] is taken back to it by the least push: among those
/// within the limit the one nearest by kinetic energy (Gauss 1829, the principle of least
/// constraint), (I + lambda) omega = L. The light axis, about which bodies tumble and flutter fast,
/// yields first; energy never grows. Returns whether it was above; else nothing changes.
bool LimitTurning(const FlightBody& body, double fastest, FlightState& state);

struct FrameEvents
{
  bool Touched = false; // the floor
  bool Slowed = false;  // by the limit of turning
  double Swept = 0.0;   // rad, all turning there and back
};

/// Takes the state from a frame to the next one: midpoint steps on the rotation group, as many as
/// the fastest rate asks for; where even the most are too few the air's force is lessened. After
/// each step the floor (or none), as it is at the frame's beginning, stops what turned through it.
/// No step turns faster, or is brought to turn otherwise more quickly, than the path's limits.
FrameEvents AdvanceFrame(const FlightBody& body, const FlightPath& path, int frame,
                         const Settling& settling, const Floor* floor, FlightState& state);

} // namespace waft
