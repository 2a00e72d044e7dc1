// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/Repair.h"

#include "Base/SmoothStep.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace waft
{

namespace
{

constexpr int PointsPerFrame = 8;
constexpr int Rounds = 40;
/// Frames to either side of what is in the way that are pushed along.
constexpr int RepairReach = 5;
/// Of the plane of rest, which nothing goes below [m].
constexpr double ContactTolerance = 1e-8;

/// What is left below a plane of rest by less than the tolerance is laid on to it.
void LayOnContacts(const ClearanceField& field, const WarpProblem& warp, double tolerance,
                   std::vector<Vec3>& path)
{
  for (std::size_t k = 0; k < path.size(); ++k)
  {
    const ContactStretch* contact = field.ContactAt(static_cast<double>(k));
    if (contact != nullptr && warp.IsFixed[k] == 0)
    {
      const double height = (path[k] - contact->Centre).dot(contact->Normal);
      if (height < 0.0 && height > -4.0 * tolerance)
      {
        path[k] -= height * contact->Normal;
      }
    }
  }
}

double Worst(const std::vector<Violation>& violations, int& frame)
{
  double worst = 0.0;
  frame = -1;
  for (const Violation& violation : violations)
  {
    if (violation.Slack < worst)
    {
      worst = violation.Slack;
      frame = violation.Frame;
    }
  }
  return worst;
}

} // namespace

std::vector<Violation> FindViolations(const ClearanceField& field,
                                      const std::vector<Vec3>& positions, double tolerance)
{
  std::vector<Violation> result;
  const auto count = static_cast<int>(positions.size());
  for (int frame = 0; frame + 1 < count; ++frame)
  {
    const Vec3& a = positions[frame];
    const Vec3& b = positions[frame + 1];
    const double step = (b - a).norm();
    double here = 1e30;
    if (!(field.Obstacles != nullptr && field.Obstacles->HasMoving()))
    {
      // With room to spare nothing between the frames can be hit.
      here = field.Distance(a, frame) - field.Required(a);
      if (here > 1.4 * step && frame + 2 < count &&
          field.ContactAt(frame) == field.ContactAt(frame + 1.0))
      {
        continue;
      }
    }
    if (step == 0.0 && here > -tolerance && here < 1e30)
    {
      continue;
    }
    Violation violation;
    violation.Frame = frame;
    const int points = frame + 2 == count ? PointsPerFrame + 1 : PointsPerFrame;
    for (int i = 0; i < points; ++i)
    {
      const double u = static_cast<double>(i) / PointsPerFrame;
      const Vec3 x = a + u * (b - a);
      Vec3 away = Vec3::Zero();
      const double slack = field.Distance(x, frame + u, away) - field.Required(x);
      if (slack < violation.Slack)
      {
        violation.Slack = slack;
        violation.Push = -slack * away;
      }
    }
    const bool atContact =
      field.ContactAt(frame) != nullptr && field.ContactAt(frame + 1.0) != nullptr;
    if (violation.Slack < -(atContact ? ContactTolerance : tolerance))
    {
      result.push_back(violation);
    }
  }
  return result;
}

std::vector<Vec3> RepairPath(const ClearanceField& field, WarpProblem warp, double tolerance,
                             double maximumStep, const std::vector<Vec3>& path,
                             const std::vector<Vec3>& fallback, double& worstSlack, int& worstFrame)
{
  std::vector<Vec3> best;
  double least = 1e300;
  const auto offer = [&](std::vector<Vec3> candidate)
  {
    LayOnContacts(field, warp, tolerance, candidate);
    std::vector<Violation> violations = FindViolations(field, candidate, tolerance);
    int frame = -1;
    const double slack = Worst(violations, frame);
    double excess = 0.0;
    for (std::size_t k = 1; k < candidate.size(); ++k)
    {
      excess = std::max(excess, (candidate[k] - candidate[k - 1]).norm() - maximumStep);
    }
    if (excess - slack < least)
    {
      least = excess - slack;
      worstSlack = slack;
      worstFrame = frame;
      best = std::move(candidate);
    }
    return violations;
  };
  std::vector<Violation> violations = offer(path);
  if (!(least > 0.0))
  {
    return best;
  }
  std::map<int, Vec3> wishes;
  std::vector<Vec3> current = path;
  for (int round = 0; round < Rounds && !violations.empty(); ++round)
  {
    // Neighbours are pushed along, less with the distance, so that no kink is made.
    std::map<int, Vec3> pushes;
    for (const Violation& violation : violations)
    {
      const Vec3 push = violation.Push + violation.Push.normalized() * (2.0 * tolerance);
      const int first = std::max(0, violation.Frame - RepairReach);
      const int last =
        std::min(static_cast<int>(current.size()) - 1, violation.Frame + 1 + RepairReach);
      for (int frame = first; frame <= last; ++frame)
      {
        const int away = std::max({ 0, violation.Frame - frame, frame - violation.Frame - 1 });
        const double u = 1.0 - away / (RepairReach + 1.0);
        const Vec3 own = CubicStep(u) * push;
        Vec3& most = pushes.emplace(frame, Vec3::Zero()).first->second;
        most = own.squaredNorm() > most.squaredNorm() ? own : most;
      }
    }
    for (const auto& [frame, push] : pushes)
    {
      if (warp.IsFixed[frame] == 0)
      {
        // Marks are soft: what one round does not bring about the next ones add.
        wishes.emplace(frame, current[frame]).first->second += push;
      }
    }
    warp.Soft.clear();
    for (const auto& [frame, value] : wishes)
    {
      warp.Soft.push_back({ frame, value, 0.05 });
    }
    current = SolveWarp(warp);
    violations = offer(current);
  }
  if (least > 0.0)
  {
    offer(fallback);
  }
  return best;
}

} // namespace waft
