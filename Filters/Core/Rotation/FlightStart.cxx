// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/FlightStart.h"

#include <cmath>

namespace waft
{
namespace
{
constexpr double TimeBefore = 2.0; // s

/// The air of frame `first` for `frames` frames and what is between them.
FlightPath AsItBegins(const FlightPath& path, int first, std::size_t frames)
{
  FlightPath before;
  before.Step = path.Step;
  before.Ease = path.Ease;
  before.QuickestChange = path.QuickestChange;
  const auto hold = [first, frames](const auto& samples, auto& held)
  {
    if (!samples.empty())
    {
      held.assign(frames, samples[static_cast<std::size_t>(first)]);
    }
  };
  hold(path.RelativeVelocities, before.RelativeVelocities);
  hold(path.AirGradients, before.AirGradients);
  hold(path.AirTurning, before.AirTurning);
  hold(path.FastestTurning, before.FastestTurning);
  return before;
}

/// Any turn is as likely as any other (Shoemake 1992).
Quat AnyTurn(Random& random)
{
  const double round = 2.0 * std::acos(-1.0);
  const double part = random.Uniform();
  const double a = round * random.Uniform();
  const double b = round * random.Uniform();
  const double out = std::sqrt(1.0 - part);
  const double in = std::sqrt(part);
  return { out * std::sin(a), out * std::cos(a), in * std::sin(b), in * std::cos(b) };
}
} // namespace

Quat HangingPose(Random& random)
{
  const double round = 2.0 * std::acos(-1.0);
  const Quat down(Eigen::AngleAxisd(0.25 * round, Vec3::UnitY())); // x to -z
  const Quat about(Eigen::AngleAxisd(round * random.Uniform(), Vec3::UnitZ()));
  return about * down;
}

FlightState StateInFlight(const FlightBody& body, const FlightPath& path, int first, Random random)
{
  const auto frames = static_cast<int>(std::ceil(TimeBefore / path.Step));
  const FlightPath before = AsItBegins(path, first, static_cast<std::size_t>(frames) + 1);
  FlightState state;
  state.Orientation = AnyTurn(random);
  state.SetVelocity(body, before.RelativeVelocities.front());
  for (int frame = 0; frame < frames; ++frame)
  {
    AdvanceFrame(body, before, frame, Settling(), nullptr, state);
  }
  return state;
}

} // namespace waft
