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

/// The first of an object's stops that does not begin before the wish.
Stops::iterator Next(Stops& own, const TargetStops& wish)
{
  return std::upper_bound(own.begin(), own.end(), wish.First.First,
                          [](int frame, const Stop& stop) { return frame <= stop.First; });
}

/// Of the leg to the wish; Never where the object cannot be there then, or not go on in time.
RankedCost CostOf(Stops& own, const TargetStops& wish, const SpeedLimit& limit)
{
  const auto next = Next(own, wish);
  const Stop& before = *std::prev(next == own.begin() ? next + 1 : next);
  if (before.Last >= wish.First.First || (next != own.end() && wish.Last.Last >= next->First))
  {
    return RankedCost::Never();
  }
  const double haste = limit.Haste(before, wish.First);
  if (haste > 1.0 || (next != own.end() && limit.Haste(wish.Last, *next) > 1.0))
  {
    return RankedCost::Never();
  }
  return { haste > PlannerNumbers::EasyHaste ? 1 : 0,
           (wish.First.Value - before.Value).squaredNorm() };
}

} // namespace

std::vector<std::size_t> CoverInTurn(const std::vector<MotionObject>& objects,
                                     std::vector<Stops> stops,
                                     const std::vector<TargetStops>& wishes,
                                     const SpeedLimit& limit)
{
  std::vector<std::size_t> chosen;
  for (const TargetStops& wish : wishes)
  {
    std::size_t best = NoObject;
    RankedCost least = RankedCost::Never();
    for (std::size_t o = 0; o < objects.size(); ++o)
    {
      if (!wish.Suits(objects[o]))
      {
        continue;
      }
      const RankedCost cost = CostOf(stops[o], wish, limit);
      if (cost.IsAllowed() && (best == NoObject || cost < least))
      {
        best = o;
        least = cost;
      }
    }
    if (best != NoObject)
    {
      Stops& own = stops[best];
      const auto at = own.insert(Next(own, wish), wish.First);
      if (wish.Last.First > wish.First.First)
      {
        own.insert(at + 1, wish.Last);
      }
    }
    chosen.push_back(best);
  }
  return chosen;
}

} // namespace waft
