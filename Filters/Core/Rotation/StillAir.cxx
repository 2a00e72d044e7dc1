// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/StillAir.h"

#include "Rotation/FlightStart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace waft
{
namespace
{

constexpr std::size_t StillFalls = 12;
constexpr int FallFrames = 240;         // of a fall
constexpr double FallStep = 1.0 / 30.0; // s
constexpr int DrawTries = 5;
constexpr double DrawTolerance = 0.015;
constexpr double DrawChange = 1.4; // of the speed, from a try to the next

/// m/s
double MeanFall(const std::function<Glider(std::size_t)>& glider, double speed,
                const ParallelFor& parallel)
{
  std::array<double, StillFalls> falls{};
  parallel(StillFalls,
           [&](std::size_t begin, std::size_t end)
           {
             for (std::size_t i = begin; i < end; ++i)
             {
               const Glider own = glider(i);
               const FlightBody body = own.DrawnAt(speed);
               FlightPath path;
               path.Step = FallStep;
               path.RelativeVelocities.assign(FallFrames + 1, Vec3(0.0, 0.0, -speed));
               path.Ease = own.Ease;
               FlightState state = StateInFlight(body, path, 0, Random(1, i));
               for (int k = 0; k < FallFrames; ++k)
               {
                 AdvanceFrame(body, path, k, Settling(), nullptr, state);
                 falls[i] -= state.Velocity(body).z() / FallFrames;
               }
             }
           });
  return std::accumulate(falls.begin(), falls.end(), 0.0) / StillFalls;
}

} // namespace

double Glider::SlippingMass(double speed) const
{
  const double drag = this->Coefficients.Drag * this->Coefficients.DragRatio(speed);
  const double weight = 0.5 * this->AirDensity * drag * this->Panels.Area() * speed * speed;
  return weight > 0.0 ? weight / StandardGravity : this->Mass;
}

FlightBody Glider::DrawnAt(double speed) const
{
  return { this->Panels,     this->Properties,   this->Mass,    this->SlippingMass(speed),
           this->AirDensity, this->Coefficients, this->Damping, this->Follow };
}

BodyFactors Glider::FactorsAt(double speed) const
{
  BodyFactors factors;
  factors.Drag = this->Coefficients.Drag;
  factors.Lift = this->Coefficients.Lift;
  factors.RotationalLift = this->Coefficients.RotationalLift;
  factors.PressureShift = this->Coefficients.PressureShift;
  factors.Spin = this->Coefficients.Spin;
  factors.SlippingMass = this->SlippingMass(speed);
  factors.BroadsideSpeed = speed;
  factors.Damping = this->Damping * this->Pace;
  factors.Follow = this->Follow * this->Pace;
  factors.Pace = this->Pace;
  return factors;
}

double DrawOverFall(const std::function<Glider(std::size_t)>& glider, double settlingSpeed,
                    const ParallelFor& parallel)
{
  const Glider first = glider(0);
  if (!(settlingSpeed > 0.0) || !(first.AirDensity > 0.0) || !first.DrawnAt(settlingSpeed).Slips)
  {
    return 1.0;
  }
  double factor = 1.0, best = 1.0;
  double least = 1e300; // deviation
  for (int k = 0; k < DrawTries && least > DrawTolerance; ++k)
  {
    const double speed = factor * settlingSpeed;
    const double fall = MeanFall(glider, speed, parallel) / settlingSpeed;
    if (std::abs(fall - 1.0) < least)
    {
      least = std::abs(fall - 1.0);
      best = factor;
    }
    factor *= std::clamp(1.0 / std::max(fall, 0.1), 1.0 / DrawChange, DrawChange);
  }
  return best;
}

} // namespace waft
