// SPDX-License-Identifier: BSD-3-Clause
#include "Rotation/Agreement.h"

#include "Rotation/KeepAbove.h"
#include "Rotation/RigidBody.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

constexpr std::size_t MostSampledWhole = 2048; // bodies
constexpr double AgreementTime = 0.5;          // s
constexpr double AgreementLanding = 2.0;       // landing times before a rest, in which it settles
constexpr double JoiningTime = 0.5;            // s

/// Whether nothing but the air bears it from a frame to another.
bool IsBorne(const AttitudePlan& plan, int from, int to)
{
  const double landing = AgreementLanding * plan.LandingTime * plan.Time.FramesPerSecond;
  return from >= plan.Object->Released() && to < static_cast<int>(plan.Path->EndPresent()) &&
         std::none_of(plan.Stays.begin(), plan.Stays.end(),
                      [&](const Constraint& stay)
                      { return to > stay.Frame && from < LastFrame(stay); }) &&
         std::none_of(plan.Rests.begin(), plan.Rests.end(),
                      [&](const LandingWindow& rest)
                      { return to > rest.Frame - landing && from < rest.Until; });
}

/// Whether nothing else turns it either.
bool FliesFreely(const AttitudePlan& plan, int from, int to)
{
  const double turning = plan.TurningTime * plan.Time.FramesPerSecond;
  return IsBorne(plan, from, to) &&
         std::none_of(plan.Keys.begin(), plan.Keys.end(),
                      [&](const Constraint& key)
                      { return to > key.Frame - turning && from <= key.Frame; });
}

FlightState StateAt(const AttitudePlan& plan, const FlightBody& body, const FlightPath& path,
                    const Quat& orientation, const Vec3& rate, const Vec3& slip)
{
  FlightState state;
  state.Orientation = orientation.normalized();
  state.SetAngularVelocity(body, rate * (plan.Time.Step() / path.Step));
  state.SetVelocity(body, slip);
  return state;
}

void Advance(const AttitudePlan& plan, const FlightBody& body, const FlightPath& path, int frame,
             FlightState& state)
{
  Floor floor;
  const bool near = FindFloor(plan, frame, path.Step, &state.Orientation, floor);
  AdvanceFrame(body, path, frame, Settling(), near ? &floor : nullptr, state);
}

} // namespace

AgreementSample AgreementSampleOf(std::size_t i, std::size_t bodies)
{
  const std::size_t fewer = (bodies + MostSampledWhole - 1) / MostSampledWhole;
  AgreementSample sample;
  sample.First = sample.Stride * static_cast<int>(fewer > 1 ? i % fewer : 0);
  sample.Stride *= static_cast<int>(std::max<std::size_t>(fewer, 1));
  return sample;
}

std::vector<double> TurnedAway(const AttitudePlan& plan, const FlightBody& body,
                               const FlightPath& path, const PoseTrack& poses,
                               const AgreementSample& sample)
{
  std::vector<double> away;
  const Track& track = *plan.Path;
  const int span =
    std::max(1, static_cast<int>(std::lround(AgreementTime * plan.Time.FramesPerSecond)));
  const int last = static_cast<int>(track.Slips.size()) - 1;
  for (int first = sample.First; first + span <= last; first += sample.Stride)
  {
    if (!FliesFreely(plan, first, first + span))
    {
      continue;
    }
    const auto from = static_cast<std::size_t>(first);
    const auto to = static_cast<std::size_t>(first + span);
    FlightState state = StateAt(plan, body, path, poses.Orientations[from],
                                poses.AngularVelocities[from], track.Slips[from]);
    for (int k = first; k < first + span; ++k)
    {
      Advance(plan, body, path, k, state);
    }
    away.push_back(LogMap(state.Orientation * poses.Orientations[to].conjugate()).norm());
  }
  return away;
}

std::vector<Vec3> SlipsAlong(const AttitudePlan& plan, const FlightBody& body,
                             const FlightPath& path)
{
  const Track& track = *plan.Path;
  std::vector<Vec3> slips = track.Slips;
  const int last = static_cast<int>(slips.size()) - 1;
  const int span =
    std::max(1, static_cast<int>(std::lround(JoiningTime * plan.Time.FramesPerSecond)));
  for (int k = 0, begin = 0; k < last; ++k)
  {
    const auto now = static_cast<std::size_t>(k);
    if (!IsBorne(plan, k, k + 1))
    {
      begin = k + 1;
      continue;
    }
    FlightState state =
      StateAt(plan, body, path, track.Orientations[now], track.AngularVelocities[now], slips[now]);
    Advance(plan, body, path, k, state);
    slips[now + 1] = state.Velocity(body);
    if (k + 1 < last && !IsBorne(plan, k + 1, k + 2))
    {
      const Vec3 step = track.Slips[now + 1] - slips[now + 1];
      slips[now + 1] = track.Slips[now + 1];
      for (int j = 1; j < span && k + 1 - j > begin; ++j)
      {
        slips[now + 1 - static_cast<std::size_t>(j)] +=
          (1.0 - static_cast<double>(j) / span) * step;
      }
    }
  }
  return slips;
}

std::array<double, 2> AgreementOf(std::vector<double> away)
{
  std::sort(away.begin(), away.end());
  const auto at = [&away](double part)
  {
    if (away.empty())
    {
      return std::nan("");
    }
    const double rank = part * static_cast<double>(away.size() - 1);
    const auto below = static_cast<std::size_t>(rank);
    const double next = away[std::min(below + 1, away.size() - 1)];
    return away[below] + (rank - static_cast<double>(below)) * (next - away[below]);
  };
  return { at(0.5), at(0.9) };
}

} // namespace waft
