// SPDX-License-Identifier: BSD-3-Clause
// Which of many places may be near to each other.
#pragma once

#include "Base/Types.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <vector>

namespace waft
{

/// Calls visit(a, b), a before b, for all pairs of places that are no farther from each other than
/// reach along x and y, and some that are; none where the reach is 0. In strips across x as wide as
/// the reach each meets those after it in its own, and those about it in the next.
template <class Visit>
void SweepPairs(const std::vector<Vec3>& places, double reach, const Visit& visit)
{
  struct Placed
  {
    double Strip, Along;
    std::size_t Number;

    bool operator<(const Placed& other) const
    {
      return std::tie(this->Strip, this->Along, this->Number) <
             std::tie(other.Strip, other.Along, other.Number);
    }
  };
  if (!(reach > 0.0))
  {
    return;
  }
  const double width = (1.0 + 1e-9) * reach; // so that rounding parts no pair by two strips
  std::vector<Placed> all(places.size());
  for (std::size_t o = 0; o < places.size(); ++o)
  {
    all[o] = { std::floor(places[o].x() / width), places[o].y(), o };
  }
  std::sort(all.begin(), all.end());
  const auto meet = [&](const Placed& one, const Placed& other)
  {
    const auto [a, b] = std::minmax(one.Number, other.Number);
    visit(a, b);
  };
  const auto reaches = [&](const Placed& one, const Placed& other, double strip)
  { return other.Strip == strip && other.Along - one.Along <= reach; };
  std::size_t next = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const Placed& one = all[i];
    std::size_t j = i + 1;
    for (; j < all.size() && reaches(one, all[j], one.Strip); ++j)
    {
      meet(one, all[j]);
    }
    const auto isBefore = [&](const Placed& other)
    {
      return other.Strip <= one.Strip ||
             (other.Strip == one.Strip + 1.0 && one.Along - other.Along > reach);
    };
    for (next = std::max(next, j); next < all.size() && isBefore(all[next]); ++next)
    {
    }
    for (j = next; j < all.size() && reaches(one, all[j], one.Strip + 1.0); ++j)
    {
      meet(one, all[j]);
    }
  }
}

} // namespace waft
