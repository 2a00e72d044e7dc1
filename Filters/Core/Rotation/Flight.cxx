// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/Flight.h"

#include "Rotation/FloorContact.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>
#include <limits>

namespace waft
{
namespace
{
constexpr int MostSteps = 256;       // a frame
constexpr double MuchFaster = 100.0; // the air across a body than its middle goes through it
constexpr double LeastContactSteps = 8.0;
constexpr double StepOfRate = 0.4;    // product of step and fastest rate
constexpr double SlipOnFloor = 10.0;  // 1/s, at which what touches loses its sideslip
constexpr double SettlingRate = 7.0;  // rad/s, critically damped
constexpr double LeastFlatness = 0.3; // below it a body has no glide of its own

struct Rates
{
  Vec3 Torque = Vec3::Zero(); // of the air
  Vec3 Momentum = Vec3::Zero();
  Vec3 AngularMomentum = Vec3::Zero();
};

template <typename T>
T Between(const std::vector<T>& samples, double frame)
{
  const double last = static_cast<double>(samples.size() - 1);
  const double f = std::clamp(frame, 0.0, last);
  const auto k = static_cast<std::size_t>(f);
  const std::size_t next = std::min(k + 1, samples.size() - 1);
  return samples[k] + (f - static_cast<double>(k)) * (samples[next] - samples[k]);
}

Vec3 Slope(const std::vector<Vec3>& samples, double frame)
{
  const auto k = static_cast<std::size_t>(std::max(frame, 0.0));
  return k + 1 < samples.size() ? Vec3(samples[k + 1] - samples[k]) : Vec3(Vec3::Zero());
}

/// How much of the potential flow's moment is there: all of it while the flow follows the plate,
/// none broadside, where it has left both edges and the pressure acts near the middle. By this
/// 1 - sin(alpha) the centre of pressure goes from the quarter chord to the centre as measured on
/// plates (Joessel 1870: its distance from the centre falls in proportion to 1 - sin(alpha)).
double Attached(const FlightBody& body, const Vec3& velocity)
{
  const double across = std::abs(velocity.dot(body.Panels->Normal()));
  return 1.0 - body.Coefficients.Separation * across / (velocity.norm() + 1e-30);
}

/// Kirchhoff's equations of a rigid body in air (Lamb 1932, section 124) in world axes,
///   dP/dt = F,  dL/dt = T - w x P,
/// with w the velocity relative to the air and P, L with the air that moves along. The term w x P
/// turns a plate broadside, as far as the flow is attached; it and the changing P keep the energy
/// of the moving air in the account.
Rates Derive(const FlightBody& body, const FlightPath& path, const FlightState& state, double frame,
             double slowing)
{
  Rates rates;
  if (body.AirDensity <= 0.0)
  {
    return rates;
  }
  const Mat3 turn = state.Orientation.toRotationMatrix();
  const Vec3 omega = turn.transpose() * state.AngularVelocity(body);
  const Vec3 given = Between(path.RelativeVelocities, frame);
  Mat3 gradient = CrossMatrix(omega);
  if (!path.AirGradients.empty())
  {
    gradient -= turn.transpose() * Between(path.AirGradients, frame) * turn;
  }
  const Vec3 velocity = body.Slips ? state.Velocity(body) : given;
  const Wrench air =
    body.Panels->Evaluate(turn.transpose() * velocity, gradient, body.Coefficients);
  const double density = slowing * body.AirDensity;
  rates.Torque = density * (turn * air.Torque);
  if (body.Slips)
  {
    // A plate broadside to its path is in balance with what draws it along; any other pose slips.
    const double drag = body.Coefficients.Drag * body.Coefficients.DragRatio(given.norm());
    const Vec3 drawn = 0.5 * drag * body.Panels->Area() * given.norm() * given;
    const Vec3 wanted =
      Slope(path.RelativeVelocities, frame) / path.Step - body.Follow * (velocity - given);
    rates.Momentum =
      density * (turn * air.Force + drawn) + turn * (body.Mass * (turn.transpose() * wanted));
    rates.Torque -=
      slowing * Attached(body, turn.transpose() * velocity) * velocity.cross(state.Momentum);
  }
  rates.AngularMomentum = rates.Torque;
  return rates;
}

/// Angular momentum falls to that of turning along with the air: the stickiness of the air turns a
/// sphere of radius R by 8 pi mu R^3 (curl u / 2 - omega) (Faxen; Happel and Brenner 1965, section
/// 5-1).
void Fade(const FlightBody& body, const FlightPath& path, double frame, double fade,
          FlightState& state)
{
  if (path.AirTurning.empty())
  {
    state.AngularMomentum *= fade;
    return;
  }
  const Mat3 turn = state.Orientation.toRotationMatrix();
  const Vec3 along = turn * (body.Inertia * (turn.transpose() * Between(path.AirTurning, frame)));
  state.AngularMomentum = along + fade * (state.AngularMomentum - along);
}

/// What is above the path's ease goes, as an angular velocity above a limit is taken back.
void EaseTurning(const FlightBody& body, const TurningEase& ease, double time, FlightState& state)
{
  const double rate = state.AngularVelocity(body).norm();
  if (rate > ease.Above)
  {
    LimitTurning(body, ease.Above + std::exp(-ease.Rate * time) * (rate - ease.Above), state);
  }
}

Vec3 SettlingTorque(const FlightBody& body, const Settling& settling, const FlightState& state)
{
  const Mat3 turn = state.Orientation.toRotationMatrix();
  const Vec3 up = turn.col(2);
  const Vec3 error = LogMap(LeastTurn(up, settling.Normal, turn.col(0)));
  const Vec3 acceleration =
    SettlingRate * SettlingRate * error - 2.0 * SettlingRate * state.AngularVelocity(body);
  return settling.Weight * (turn * (body.Inertia * (turn.transpose() * acceleration)));
}
/// Momentum L [kg m^2/s] is taken back to what gives at most the rate `most`, by the least of
/// |omega - I^-1 L|^2 in the metric of the inertia I; so is a torque to what gives at most an
/// angular acceleration. Returns whether it gave more.
bool TakeBack(const FlightBody& body, const Quat& orientation, double most, Vec3& momentum)
{
  const Mat3 turn = orientation.toRotationMatrix();
  if (!((body.InverseInertia * (turn.transpose() * momentum)).norm() > most))
  {
    return false;
  }
  const Mat3 axes = turn * body.PrincipalAxes;
  const Vec3 given = axes.transpose() * momentum;
  double lambda = 0.0;
  Vec3 omega = given.cwiseQuotient(body.PrincipalInertia);
  double rate = omega.norm();
  // 1 / rate is nearly straight in lambda and Newton's steps for it come from one side.
  for (int i = 0; i < 50 && rate > most * (1.0 + 1e-12); ++i)
  {
    const Vec3 yielding = body.PrincipalInertia + Vec3::Constant(lambda);
    lambda += rate * rate / omega.dot(omega.cwiseQuotient(yielding)) * (rate / most - 1.0);
    omega = given.cwiseQuotient(body.PrincipalInertia + Vec3::Constant(lambda));
    rate = omega.norm();
  }
  omega *= std::min(1.0, most * (1.0 - 1e-12) / rate);
  momentum = axes * body.PrincipalInertia.cwiseProduct(omega);
  return true;
}

} // namespace

FlightBody::FlightBody(const PanelBody& panels, const ShellProperties& properties, double mass,
                       double airDensity, const AirCoefficients& coefficients, double damping,
                       double follow) :
  FlightBody(panels, properties, mass, mass, airDensity, coefficients, damping, follow)
{
}

FlightBody::FlightBody(const PanelBody& panels, const ShellProperties& properties, double mass,
                       double moved, double airDensity, const AirCoefficients& coefficients,
                       double damping, double follow) :
  Panels(&panels),
  Coefficients(coefficients), AirDensity(airDensity), Damping(damping), Follow(follow)
{
  const bool plate = coefficients.Model == AirModel::Plate;
  this->Inertia = mass * properties.InertiaPerMass;
  this->Mass = moved * Mat3::Identity();
  if (plate)
  {
    this->Inertia += airDensity * panels.AddedInertia();
    this->Mass += airDensity * panels.AddedMass();
  }
  // A straight line of triangles has no inertia about itself.
  this->Inertia += 1e-9 * this->Inertia.trace() * Mat3::Identity();
  this->InverseInertia = this->Inertia.inverse();
  const Eigen::SelfAdjointEigenSolver<Mat3> principal(this->Inertia);
  this->PrincipalInertia = principal.eigenvalues();
  this->PrincipalAxes = principal.eigenvectors();
  this->InverseMass = this->Mass.inverse();
  this->Slips = plate && panels.Flatness() >= LeastFlatness;

  const Mat3& spread = properties.SecondMoment;
  this->Reach = std::sqrt(spread.trace());
  const double press =
    airDensity * coefficients.Drag * panels.Area() * (plate ? 1.0 + coefficients.Lift : 1.0);
  const Mat3 arms = spread.trace() * Mat3::Identity() - spread;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Mat3> damped(arms, this->Inertia,
                                                              Eigen::EigenvaluesOnly);
  const Vec3& n = panels.Normal();
  this->Mobility = std::max(press * damped.eigenvalues().maxCoeff(),
                            this->Slips ? press * n.dot(this->InverseMass * n) : 0.0);
  const Eigen::SelfAdjointEigenSolver<Mat3> inertia(this->Inertia, Eigen::EigenvaluesOnly);
  const double stiff = 0.5 * press * this->Reach + airDensity * panels.AddedMass().trace();
  this->Stiffness = std::sqrt(stiff / inertia.eigenvalues()[0]);
}

Vec3 FlightState::AngularVelocity(const FlightBody& body) const
{
  const Mat3 turn = this->Orientation.toRotationMatrix();
  return turn * (body.InverseInertia * (turn.transpose() * this->AngularMomentum));
}

void FlightState::SetAngularVelocity(const FlightBody& body, const Vec3& omega)
{
  const Mat3 turn = this->Orientation.toRotationMatrix();
  this->AngularMomentum = turn * (body.Inertia * (turn.transpose() * omega));
}

Vec3 FlightState::Velocity(const FlightBody& body) const
{
  const Mat3 turn = this->Orientation.toRotationMatrix();
  return turn * (body.InverseMass * (turn.transpose() * this->Momentum));
}

void FlightState::SetVelocity(const FlightBody& body, const Vec3& velocity)
{
  const Mat3 turn = this->Orientation.toRotationMatrix();
  this->Momentum = turn * (body.Mass * (turn.transpose() * velocity));
}

Vec3 AirTorque(const FlightBody& body, const FlightPath& path, const FlightState& state,
               double frame)
{
  return Derive(body, path, state, frame, 1.0).Torque;
}

bool LimitTurning(const FlightBody& body, double fastest, FlightState& state)
{
  return TakeBack(body, state.Orientation, fastest, state.AngularMomentum);
}

FrameEvents AdvanceFrame(const FlightBody& body, const FlightPath& path, int frame,
                         const Settling& settling, const Floor* floor, FlightState& state)
{
  FrameEvents events;
  const double fastest = path.FastestTurning.empty() ? std::numeric_limits<double>::infinity()
                                                     : path.FastestTurning[frame];
  const bool limited = std::isfinite(fastest);
  events.Slowed = LimitTurning(body, fastest, state);
  const double spin = state.AngularVelocity(body).norm();
  double speed = std::max(path.RelativeVelocities[frame].norm(),
                          Between(path.RelativeVelocities, frame + 1.0).norm()) +
                 (body.Slips ? state.Velocity(body).norm() : 0.0) + spin * body.Reach;
  const double across =
    path.AirGradients.empty() ? 0.0 : path.AirGradients[frame].norm() * body.Reach;
  speed = across > MuchFaster * speed ? across : speed;
  const double mobility = body.Mobility * body.Coefficients.DragRatio(speed);
  const double rate = std::max({ spin, mobility * speed, body.Stiffness * speed,
                                 settling.Weight > 0.0 ? 2.0 * SettlingRate : 0.0 });
  const double wanted = std::ceil(path.Step * rate / StepOfRate);
  const int steps = static_cast<int>(
    std::clamp(wanted, floor != nullptr ? LeastContactSteps : 2.0, static_cast<double>(MostSteps)));
  const double slowing = wanted > MostSteps ? MostSteps / wanted : 1.0;
  const double h = path.Step / steps;
  const double fade = std::exp(-0.5 * h * body.Damping);
  const Quat since = state.Orientation;
  for (int i = 0; i < steps; ++i)
  {
    const double here = frame + static_cast<double>(i) / steps;
    // Damping is exact in two halves about the step, so that its rate holds for any step.
    Fade(body, path, here, fade, state);
    Rates rates = Derive(body, path, state, here, slowing);
    if (settling.Weight > 0.0)
    {
      rates.AngularMomentum += SettlingTorque(body, settling, state);
    }
    if (limited)
    {
      events.Slowed =
        TakeBack(body, state.Orientation, path.QuickestChange, rates.AngularMomentum) ||
        events.Slowed;
    }
    FlightState middle = state;
    middle.Orientation = ExpMap(0.5 * h * state.AngularVelocity(body)) * state.Orientation;
    middle.AngularMomentum += 0.5 * h * rates.AngularMomentum;
    middle.Momentum += 0.5 * h * rates.Momentum;
    events.Slowed = LimitTurning(body, fastest, middle) || events.Slowed;
    rates = Derive(body, path, middle, here + 0.5 / steps, slowing);
    if (settling.Weight > 0.0)
    {
      rates.AngularMomentum += SettlingTorque(body, settling, middle);
    }
    if (limited)
    {
      events.Slowed =
        TakeBack(body, middle.Orientation, path.QuickestChange, rates.AngularMomentum) ||
        events.Slowed;
    }
    const Vec3 turn = h * middle.AngularVelocity(body);
    state.Orientation = (ExpMap(turn) * state.Orientation).normalized();
    events.Swept += turn.norm();
    state.AngularMomentum += h * rates.AngularMomentum;
    state.Momentum += h * rates.Momentum;
    Fade(body, path, here + 1.0 / steps, fade, state);
    EaseTurning(body, path.Ease, h, state);
    if (floor != nullptr)
    {
      const Floor now = floor->After((i + 1) * h);
      if (PressOnFloor(body, now, h, state) && body.Slips)
      {
        const Vec3 along = Between(path.RelativeVelocities, here + 1.0 / steps);
        const Vec3 slip = std::exp(-SlipOnFloor * h) * (state.Velocity(body) - along);
        state.SetVelocity(body, along + slip);
      }
      // A floor that may lift the centre instead turns it no faster than an eye follows.
      const ContactRoom room{ since, (i + 1) * h * std::min(fastest, path.Ease.Above) };
      events.Touched = TouchFloor(body, now, state, room) || events.Touched;
    }
    events.Slowed = LimitTurning(body, fastest, state) || events.Slowed;
  }
  return events;
}

} // namespace waft
