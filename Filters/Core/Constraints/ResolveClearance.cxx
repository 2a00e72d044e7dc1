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

constexpr double MarkSlope = 0.3; // of the radius from a tight mark on: a path can leave so fast
constexpr int StepParts = 8;      // points from a frame to the next that are looked at
constexpr int SmallestRamp = 6;   // frames over which the fallback blends in
constexpr double FallbackSpeed = 0.3; // of going back to the fallback, at most [m/s]
constexpr int FallbackRounds = 5;     // the ramp doubles each time

/// From a landed surface and the volume's sides, where they are cut; from others in any case.
Vec3 WayOut(const PathClearance& clearance, const Vec3& x, double frame)
{
  const double slack = clearance.Slack;
  const Clearance asked = RequiredClearance(clearance.RuleOn(x, x), clearance.Landings, frame);
  Vec3 way = Vec3::Zero();
  const auto offer = [&way](double length, const Vec3& direction)
  { way = length > way.norm() ? Vec3(length * direction) : way; };
  SurfaceHit hit;
  const double distance = clearance.Obstacles.SignedDistance(x, frame, hit, asked.Exempt);
  offer(asked.Radius + slack - distance, hit.Normal);
  double floor = asked.Radius;
  if (asked.Exempt >= 0)
  {
    floor = asked.LandingDistance - LandingSlack;
    const double height = clearance.Obstacles.SignedDistanceTo(asked.Exempt, x, frame, hit);
    offer(height < floor ? asked.LandingDistance - height : 0.0, hit.Normal);
  }
  const Box& volume = clearance.Around.At(frame);
  for (int c = 0; c < 3; ++c)
  {
    const double least = c == 2 ? floor : asked.Radius;
    const double low = x[c] - volume.Min[c];
    const double high = volume.Max[c] - x[c];
    offer(low < least ? least + slack - low : 0.0, Vec3::Unit(c));
    offer(high < asked.Radius ? asked.Radius + slack - high : 0.0, -Vec3::Unit(c));
  }
  return way;
}

bool PushOut(const PathClearance& clearance, const PathFreedom& freedom, std::vector<Vec3>& x)
{
  std::vector<std::size_t> blocked = clearance.BlockedSteps(x);
  for (int round = 0; round < freedom.Rounds && !blocked.empty(); ++round)
  {
    std::vector<Vec3> lacking = clearance.Lacking(x, blocked);
    for (Vec3& push : lacking)
    {
      push += freedom.Beyond * push.normalized(); // zero stays zero
    }
    const std::vector<Vec3> pushes = SpreadPushes(lacking, freedom.Reach);
    if (freedom.Yield)
    {
      freedom.Yield(pushes, x);
    }
    else
    {
      for (std::size_t f = 0; f < x.size(); ++f)
      {
        x[f] += freedom.Weights[f] * pushes[f];
      }
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

double Required(const ClearanceRule& rule, const std::vector<TightMark>& tight, const Vec3& a,
                const Vec3& b)
{
  double required = rule.Radius;
  const Vec3 way = b - a;
  const double square = way.squaredNorm();
  for (const TightMark& mark : tight)
  {
    const Vec3 from = mark.Position - a;
    const double u = square > 0.0 ? std::clamp(from.dot(way) / square, 0.0, 1.0) : 0.0;
    required = std::min(required, mark.Distance + MarkSlope * (from - u * way).norm());
  }
  return required;
}

ClearanceRule PathClearance::RuleOn(const Vec3& a, const Vec3& b) const
{
  return ClearanceRule(Required(this->Rule, this->TightMarks, a, b), this->Rule.RestHeight)
    .With(-this->Slack);
}

std::vector<std::size_t> PathClearance::BlockedSteps(const std::vector<Vec3>& path) const
{
  const auto keepsInside = [&](std::size_t k)
  {
    const ClearanceRule rule = this->RuleOn(path[k], path[k]);
    return KeepsInside(this->Around.At(static_cast<double>(k)),
                       RequiredClearance(rule, this->Landings, static_cast<double>(k)), path[k]);
  };
  std::vector<std::size_t> blocked;
  for (std::size_t k = 0; k + 1 < path.size(); ++k)
  {
    const double frame = static_cast<double>(k);
    if (!keepsInside(k) || !keepsInside(k + 1) ||
        !IsMotionClear(this->Obstacles, this->RuleOn(path[k], path[k + 1]), this->Landings, path[k],
                       frame, path[k + 1], frame + 1.0))
    {
      blocked.push_back(k);
    }
  }
  return blocked;
}

std::vector<Vec3> PathClearance::Lacking(const std::vector<Vec3>& path,
                                         const std::vector<std::size_t>& blocked) const
{
  std::vector<Vec3> lacking(path.size(), Vec3::Zero());
  for (const std::size_t k : blocked)
  {
    Vec3 most = Vec3::Zero();
    for (int i = 0; i <= StepParts; ++i)
    {
      const double part = static_cast<double>(i) / StepParts;
      const Vec3 here =
        WayOut(*this, path[k] + part * (path[k + 1] - path[k]), static_cast<double>(k) + part);
      most = here.norm() > most.norm() ? here : most;
    }
    for (const std::size_t f : { k, k + 1 })
    {
      lacking[f] = most.norm() > lacking[f].norm() ? most : lacking[f];
    }
  }
  return lacking;
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
