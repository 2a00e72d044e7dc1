// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/ClearPath.h"

#include "Planning/PlannerNumbers.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace waft
{

namespace
{

/// What is left below a plane of rest by about the tolerance is laid on to it.
void LayOnLandings(const ClearanceField& field, const WarpProblem& warp, double tolerance,
                   std::vector<Vec3>& path)
{
  for (std::size_t k = 0; k < path.size(); ++k)
  {
    const LandingWindow* landing = field.LandingAt(static_cast<double>(k));
    if (landing != nullptr && warp.IsFixed[k] == 0)
    {
      const double height =
        (path[k] - landing->Centre.At(static_cast<double>(k))).dot(landing->Normal);
      if (height < 0.0 && height > -PlannerNumbers::LaidOn * tolerance)
      {
        path[k] -= height * landing->Normal;
      }
    }
  }
}

PathShortfall ShortfallOf(const PathClearance& clearance, const std::vector<Vec3>& path)
{
  PathShortfall worst;
  const std::vector<Vec3> lacking = clearance.Lacking(path, clearance.BlockedSteps(path));
  for (std::size_t k = 0; k < lacking.size(); ++k)
  {
    if (lacking[k].norm() > worst.Depth)
    {
      worst = { lacking[k].norm(), static_cast<int>(k) };
    }
  }
  return worst;
}

double SpeedExcess(const std::vector<Vec3>& path, double mostStep)
{
  double excess = 0.0;
  for (std::size_t k = 1; k < path.size(); ++k)
  {
    excess = std::max(excess, (path[k] - path[k - 1]).norm() - mostStep);
  }
  return excess;
}

} // namespace

std::vector<Vec3> ClearPath(const ClearanceField& field, WarpProblem warp,
                            const ClearPathOptions& options, const std::vector<Vec3>& united,
                            const std::vector<Vec3>& separate, PathShortfall& shortfall)
{
  const PathClearance clearance{ *field.Obstacles, field.Bounds,      field.Landings,
                                 field.Rule,       options.Tolerance, field.TightMarks };
  PathFreedom freedom;
  for (const unsigned char isFixed : warp.IsFixed)
  {
    freedom.Weights.push_back(isFixed != 0 ? 0.0 : 1.0);
  }
  freedom.FrameStep = options.FrameStep;
  freedom.Rounds = PlannerNumbers::RepairRounds;
  freedom.Beyond = PlannerNumbers::RepairBeyond * options.Tolerance;
  freedom.Reach = PlannerNumbers::RepairReach;
  freedom.MeetRows = [&](std::vector<Vec3>& path)
  { LayOnLandings(field, warp, options.Tolerance, path); };
  std::map<int, Vec3> wanted;
  freedom.Yield = [&](const std::vector<Vec3>& pushes, std::vector<Vec3>& path)
  {
    for (std::size_t k = 0; k < path.size(); ++k)
    {
      if (warp.IsFixed[k] == 0 && !pushes[k].isZero(0.0))
      {
        // Marks are soft: what one round does not bring about the next ones add.
        wanted.emplace(static_cast<int>(k), path[k]).first->second += pushes[k];
      }
    }
    warp.Soft.clear();
    for (const auto& [frame, value] : wanted)
    {
      warp.Soft.push_back({ frame, value, PlannerNumbers::RepairPull });
    }
    path = SolveWarp(warp);
  };

  std::vector<Vec3> best;
  double least = 1e300;
  const auto offer = [&](const std::vector<Vec3>& candidate)
  {
    const PathShortfall own = ShortfallOf(clearance, candidate);
    const double merit = own.Depth + SpeedExcess(candidate, options.MostStep);
    if (merit < least)
    {
      least = merit;
      shortfall = own;
      best = candidate;
    }
  };
  std::vector<Vec3> path = united;
  freedom.MeetRows(path);
  offer(path);
  if (least > 0.0)
  {
    ResolveClearance(clearance, freedom, separate, path);
    offer(path);
  }
  if (least > 0.0)
  {
    path = separate;
    freedom.MeetRows(path);
    offer(path);
  }
  return best;
}

} // namespace waft
