// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/RowTurns.h"

#include "Constraints/LeastCost.h"
#include "Planning/PlannerNumbers.h"

#include <algorithm>

namespace waft
{

namespace
{

using Stops = std::vector<Stop>;

/// The first of an object's stops that does not begin before the target.
Stops::iterator Next(Stops& own, const TargetStops& target)
{
  return std::upper_bound(own.begin(), own.end(), target.First.First,
                          [](int frame, const Stop& stop) { return frame <= stop.First; });
}

/// Of the leg to the target; Never where the object cannot be there then, or not go on in time.
RankedCost CostOf(Stops& own, const TargetStops& target, const SpeedLimit& limit)
{
  const auto next = Next(own, target);
  const Stop& before = *std::prev(next == own.begin() ? next + 1 : next);
  if (before.Last >= target.First.First || (next != own.end() && target.Last.Last >= next->First))
  {
    return RankedCost::Never();
  }
  const double haste = limit.Haste(before, target.First);
  if (haste > 1.0 || (next != own.end() && limit.Haste(target.Last, *next) > 1.0))
  {
    return RankedCost::Never();
  }
  return { haste > PlannerNumbers::EasyHaste ? 1 : 0,
           (target.First.Value - before.Value).squaredNorm() };
}

} // namespace

std::vector<std::size_t> CoverInTurn(const std::vector<MotionObject>& objects,
                                     std::vector<Stops> stops,
                                     const std::vector<TargetStops>& targets,
                                     const SpeedLimit& limit)
{
  std::vector<std::size_t> chosen;
  for (const TargetStops& target : targets)
  {
    std::size_t best = NoObject;
    RankedCost least = RankedCost::Never();
    for (std::size_t o = 0; o < objects.size(); ++o)
    {
      if (!target.Suits(objects[o]))
      {
        continue;
      }
      const RankedCost cost = CostOf(stops[o], target, limit);
      if (cost.IsAllowed() && (best == NoObject || cost < least))
      {
        best = o;
        least = cost;
      }
    }
    if (best != NoObject)
    {
      Stops& own = stops[best];
      const auto at = own.insert(Next(own, target), target.First);
      if (target.Last.First > target.First.First)
      {
        own.insert(at + 1, target.Last);
      }
    }
    chosen.push_back(best);
  }
  return chosen;
}

} // namespace waft
