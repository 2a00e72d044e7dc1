// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/ResolveClearance.h"

#include "Base/SmoothStep.h"
#include "Base/SpreadPushes.h"

#include <algorithm>
#include <cmath>

namespace waft
{
namespace
{

constexpr int PushRounds = 8;
constexpr int PushReach = 15;         // frames to either side over which a push comes and goes
constexpr int SmallestRamp = 6;       // frames over which the fallback blends in
constexpr double FallbackSpeed = 0.3; // of going back to the fallback, at most [m/s]
constexpr int FallbackRounds = 5;     // the ramp doubles each time

/// By frame, the farthest that the steps after `blocked` frames have to move at it [m].
std::vector<Vec3> PushesOf(const PathClearance& clearance, const std::vector<Vec3>& x,
                           const std::vector<std::size_t>& blocked)
{
  std::vector<Vec3> pushes(x.size(), Vec3::Zero());
  for (const std::size_t k : blocked)
  {
    Vec3 push = Vec3::Zero();
    for (const double part : { 0.0, 0.5, 1.0 })
    {
      const Vec3 here =
        clearance.Lacking(x[k] + part * (x[k + 1] - x[k]), static_cast<double>(k) + part);
      push = here.norm() > push.norm() ? here : push;
    }
    for (const std::size_t f : { k, k + 1 })
    {
      pushes[f] = push.norm() > pushes[f].norm() ? push : pushes[f];
    }
  }
  return pushes;
}

bool PushOut(const PathClearance& clearance, const PathFreedom& freedom, std::vector<Vec3>& x)
{
  std::vector<std::size_t> blocked = clearance.BlockedSteps(x);
  for (int round = 0; round < PushRounds && !blocked.empty(); ++round)
  {
    const std::vector<Vec3> pushes = SpreadPushes(PushesOf(clearance, x, blocked), PushReach);
    for (std::size_t f = 0; f < x.size(); ++f)
    {
      x[f] += freedom.Weights[f] * pushes[f];
    }
    freedom.MeetRows(x);
    blocked = clearance.BlockedSteps(x);
  }
  return blocked.empty();
}

bool GoBack(const PathClearance& clearance, const PathFreedom& freedom,
            const std::vector<Vec3>& fallback, std::vector<Vec3>& x)
{
  const std::vector<Vec3> free = x;
  std::vector<double> fractions(x.size(), 0.0); // of the fallback, by frame
  std::vector<std::size_t> blocked = clearance.BlockedSteps(x);
  long shortest = SmallestRamp;
  for (int round = 0; round < FallbackRounds && !blocked.empty(); ++round, shortest *= 2)
  {
    for (const std::size_t k : blocked)
    {
      // As long as it takes to change over without a jump of speed.
      const double away = (fallback[k] - free[k]).norm();
      const long ramp =
        std::max<long>(shortest, std::lround(1.5 * away / (FallbackSpeed * freedom.FrameStep)));
      const long first = static_cast<long>(k) - ramp;
      const long last = static_cast<long>(k) + 1 + ramp;
      for (long f = std::max(0L, first); f <= std::min<long>(last, long(x.size()) - 1); ++f)
      {
        const double outside =
          std::max({ 0.0, double(k) - double(f) - 1.0, double(f) - double(k) - 2.0 });
        const double s = 1.0 - outside / static_cast<double>(ramp);
        fractions[f] = std::max(fractions[f], freedom.Weights[f] * SmoothStep(s));
      }
    }
    for (std::size_t f = 0; f < x.size(); ++f)
    {
      x[f] = free[f] + fractions[f] * (fallback[f] - free[f]);
    }
    freedom.MeetRows(x);
    blocked = clearance.BlockedSteps(x);
  }
  return blocked.empty();
}

} // namespace

std::vector<std::size_t> PathClearance::BlockedSteps(const std::vector<Vec3>& path) const
{
  const ClearanceRule rule = this->Rule.With(-this->Slack);
  const auto keepsInside = [&](std::size_t k)
  {
    return KeepsInside(this->Volume,
                       RequiredClearance(rule, this->Landings, static_cast<double>(k)), path[k]);
  };
  std::vector<std::size_t> blocked;
  for (std::size_t k = 0; k + 1 < path.size(); ++k)
  {
    const double frame = static_cast<double>(k);
    if (!keepsInside(k) || !keepsInside(k + 1) ||
        !IsMotionClear(this->Obstacles, rule, this->Landings, path[k], frame, path[k + 1],
                       frame + 1.0))
    {
      blocked.push_back(k);
    }
  }
  return blocked;
}

Vec3 PathClearance::Lacking(const Vec3& x, double frame) const
{
  const Clearance asked = RequiredClearance(this->Rule.With(-this->Slack), this->Landings, frame);
  SurfaceHit hit;
  const double distance = this->Obstacles.SignedDistance(x, frame, hit, asked.Exempt);
  return std::max(0.0, asked.Radius + this->Slack - distance) * hit.Normal;
}

bool ResolveClearance(const PathClearance& clearance, const PathFreedom& freedom,
                      const std::vector<Vec3>& fallback, std::vector<Vec3>& path)
{
  const std::vector<Vec3> found = path;
  if (PushOut(clearance, freedom, path))
  {
    return true;
  }
  path = found;
  return GoBack(clearance, freedom, fallback, path);
}

} // namespace waft
