// SPDX-License-Identifier: BSD-3-Clause
// Which of many places may be near to each other.
#pragma once

#include "Base/Types.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace waft
{

/// Calls visit(a, b), a before b, for each pair of places that are no farther from each other than
/// reach along x, where they are swept.
template <class Visit>
void SweepPairs(const std::vector<Vec3>& places, double reach, const Visit& visit)
{
  std::vector<std::size_t> order(places.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b)
            { return places[a].x() != places[b].x() ? places[a].x() < places[b].x() : a < b; });
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    for (std::size_t j = i + 1;
         j < order.size() && places[order[j]].x() - places[order[i]].x() <= reach; ++j)
    {
      const auto [a, b] = std::minmax(order[i], order[j]);
      visit(a, b);
    }
  }
}

} // namespace waft
