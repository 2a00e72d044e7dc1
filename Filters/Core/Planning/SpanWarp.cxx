// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/SpanWarp.h"

#include "Base/SmoothStep.h"
#include "Constraints/Rest.h"
#include "Planning/FreeSpaceGrid.h"
#include "Planning/PlannerNumbers.h"

#include <algorithm>
#include <cmath>

namespace waft
{

std::vector<Vec3> SpanWarp::Frames() const
{
  const std::vector<Vec3> solved = SolveWarp(this->Problem);
  return { solved.begin() + this->Before, solved.begin() + this->Before + this->Clock.Frames + 1 };
}

SpanWarp LaySpan(const SpanRequest& request, const SpanClock& clock, const std::vector<Vec3>& path,
                 const Vec3& end, bool toGoal)
{
  SpanWarp span;
  span.Clock = clock;
  span.Before = static_cast<int>(request.Before.size());
  span.After = request.Goal.IsRest && toGoal ? 2 : 0;
  const int before = span.Before;
  const int count = before + clock.Frames + 1 + span.After;

  Vec3 goal = request.Goal.Position;
  if (toGoal && request.GoalRadius > 0.0)
  {
    const Vec3 offset = path.back() - goal;
    const double distance = offset.norm();
    goal += offset * std::min(1.0, PlannerNumbers::GoalFraction * request.GoalRadius /
                                     std::max(distance, 1e-300));
  }
  WarpProblem& warp = span.Problem;
  warp.SecondDifferences.assign(count, Vec3::Zero());
  warp.IsFixed.assign(count, 0);
  warp.Fixed.assign(count, Vec3::Zero());
  const std::vector<Vec3> bends = SecondDifferences(path);
  std::copy(bends.begin() + 1, bends.begin() + clock.Frames,
            warp.SecondDifferences.begin() + before + 1);
  const auto fix = [&](int k, const Vec3& value)
  {
    warp.IsFixed[k] = 1;
    warp.Fixed[k] = value;
  };
  for (int k = 0; k < before; ++k)
  {
    fix(k, request.Before[k]);
  }
  fix(before, request.Start.Position);
  if (before > 0 && clock.Frames > 1 && clock.LaunchFrames == 0)
  {
    warp.SecondDifferences[before] = bends[1];
  }
  for (int k = 0; k <= span.After && toGoal; ++k)
  {
    fix(before + clock.Frames + k, goal + request.RideAt(clock.Frames + k));
  }
  if (!toGoal)
  {
    // The end stays where the trees, which are clear, have it.
    fix(before + clock.Frames, end);
  }
  if (before == 0 && request.Start.HasVelocity && clock.Frames >= 3)
  {
    warp.Rows.push_back({ { 0, 1, 2 }, { -1.5, 2.0, -0.5 }, request.Start.Velocity });
  }
  if (toGoal && request.Guide.size() > 1)
  {
    const double pull = PlannerNumbers::GuidePull * request.GuideWeight * request.GuideWeight;
    for (int k = 1; k < clock.Frames; ++k)
    {
      const double fraction = clock.Flown(k) / clock.FlightFrames();
      warp.Soft.push_back({ before + k, PointAlong(request.Guide, fraction), pull });
    }
  }
  return span;
}

void BringDown(const SpanRequest& request, const SegmentLibrary& library, SpanWarp& span,
               std::vector<Vec3>& positions)
{
  const double second = library.Options().FramesPerSecond;
  const auto cushion = static_cast<int>(std::lround(second * CushionTime));
  const auto inner = static_cast<int>(std::lround(PlannerNumbers::SinkTime * second));
  const auto outer = static_cast<int>(std::lround(PlannerNumbers::SettleTime * second));
  const int frames = span.Clock.Frames;
  if (!(request.Goal.Descent > 0.0) || span.After == 0 || cushion < 2 ||
      frames - outer < span.Clock.LaunchFrames + 3)
  {
    return;
  }
  const int a = frames - outer;
  const int b = frames - inner;
  span.Landing = a;
  const double own =
    ((positions[a] - positions[b]) - (request.RideAt(a) - request.RideAt(b))).z() / (b - a);
  // A goal that is near in time may be far below: the rest of the span must not have to dive.
  const double drop = request.Start.Position.z() - request.Goal.Position.z();
  const double affordable =
    (drop - PlannerNumbers::DivingFraction * library.TopStep() * b) / (inner - 0.5 * cushion);
  const double most = std::max(request.Goal.Descent, affordable);
  const double descent = std::clamp(own, PlannerNumbers::SlowestSink * request.Goal.Descent, most);
  std::vector<Vec3>& bends = span.Problem.SecondDifferences;
  for (int k = 1; k < frames; ++k)
  {
    const int left = frames - k; // to the ground
    double& bend = bends[span.Before + k].z();
    if (left >= outer)
    {
      const double u = std::min(1.0, (left - outer) / (PlannerNumbers::FadeTime * second));
      bend *= CubicStep(u);
    }
    else
    {
      const double u = static_cast<double>(left) / cushion;
      bend = u < 1.0 ? descent * 6.0 * u * (1.0 - u) / cushion : 0.0;
      bend += (request.RideAt(k + 1) - 2.0 * request.RideAt(k) + request.RideAt(k - 1)).z();
    }
  }
  // Only the height is bound; along the ground the rows ask for what is there.
  LinearRow sinking{ { span.Before + a, span.Before + b },
                     { -1.0, 1.0 },
                     positions[b] - positions[a] };
  sinking.Value.z() = -descent * (b - a) + (request.RideAt(b) - request.RideAt(a)).z();
  LinearRow height{ { span.Before + b }, { 1.0 }, positions[b] };
  height.Value.z() =
    positions[frames].z() + descent * (inner - 0.5 * cushion) + request.RideAt(b).z();
  span.Problem.Rows.push_back(sinking);
  span.Problem.Rows.push_back(height);
  positions = span.Frames();
}

} // namespace waft
