// SPDX-License-Identifier: BSD-3-Clause
#include "Constraints/Arrivals.h"

#include "Base/Random.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>

namespace waft
{
namespace
{

constexpr TimeSpread Spreads[] = { TimeSpread::Even, TimeSpread::EaseIn, TimeSpread::EaseOut };
static_assert(std::size(Spreads) == NumberOfTimeSpreads);

} // namespace

const char* ToString(TimeSpread spread)
{
  switch (spread)
  {
    case TimeSpread::Even:
      break;
    case TimeSpread::EaseIn:
      return "ease-in";
    case TimeSpread::EaseOut:
      return "ease-out";
  }
  return "even";
}

const TimeSpread* FindTimeSpread(const std::string& name)
{
  const auto* found = std::find_if(std::begin(Spreads), std::end(Spreads),
                                   [&](TimeSpread one) { return name == ToString(one); });
  return found == std::end(Spreads) ? nullptr : found;
}

double SpreadOf(TimeSpread spread, double part)
{
  switch (spread)
  {
    case TimeSpread::Even:
      break;
    case TimeSpread::EaseIn:
      return part * part;
    case TimeSpread::EaseOut:
      return 1.0 - (1.0 - part) * (1.0 - part);
  }
  return part;
}

int FrameAt(const FrameWindow& window, TimeSpread spread, double part)
{
  return window.From + static_cast<int>(std::lround(SpreadOf(spread, part) *
                                                    static_cast<double>(window.To - window.From)));
}

double PartOfRank(std::size_t rank, std::size_t count)
{
  return count > 1 ? static_cast<double>(rank) / static_cast<double>(count - 1) : 0.0;
}

std::vector<double> PartsByKey(const std::vector<double>& keys)
{
  std::vector<std::size_t> order(keys.size());
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
  std::vector<double> parts(keys.size());
  for (std::size_t rank = 0; rank < order.size(); ++rank)
  {
    parts[order[rank]] = PartOfRank(rank, order.size());
  }
  return parts;
}

std::vector<double> PartsByRank(const std::vector<int>& ranks)
{
  std::vector<double> parts;
  for (const int rank : ranks)
  {
    parts.push_back(PartOfRank(static_cast<std::size_t>(rank), ranks.size()));
  }
  return parts;
}

std::vector<double> PartsByChance(std::size_t count, std::uint64_t seed, std::uint64_t stream)
{
  std::vector<double> keys(count);
  Random random(seed, stream);
  std::generate(keys.begin(), keys.end(), [&] { return random.Uniform(); });
  return PartsByKey(keys);
}

namespace
{
constexpr PlaceOrder AllPlaceOrders[] = { PlaceOrder::LeftToRight, PlaceOrder::RightToLeft,
                                          PlaceOrder::TopDown,     PlaceOrder::BottomUp,
                                          PlaceOrder::Outward,     PlaceOrder::Inward,
                                          PlaceOrder::Random };

double KeyOf(PlaceOrder order, const OrderedPlace& place, const Vec3& middle)
{
  switch (order)
  {
    case PlaceOrder::LeftToRight:
      return place.Across;
    case PlaceOrder::RightToLeft:
      return -place.Across;
    case PlaceOrder::TopDown:
      return -place.Up;
    case PlaceOrder::BottomUp:
      return place.Up;
    case PlaceOrder::Outward:
      return (place.Position - middle).norm();
    case PlaceOrder::Inward:
      return -(place.Position - middle).norm();
    case PlaceOrder::Random: // by no key
      break;
  }
  return 0.0;
}
} // namespace

const char* ToString(PlaceOrder order)
{
  constexpr const char* names[] = { "left-to-right", "right-to-left", "top-down", "bottom-up",
                                    "outward",       "inward",        "random" };
  return names[static_cast<std::size_t>(order)];
}

const PlaceOrder* FindPlaceOrder(const std::string& name)
{
  const auto* found = std::find_if(std::begin(AllPlaceOrders), std::end(AllPlaceOrders),
                                   [&](PlaceOrder order) { return name == ToString(order); });
  return found == std::end(AllPlaceOrders) ? nullptr : found;
}

std::vector<double> PartsByPlace(PlaceOrder order, const std::vector<OrderedPlace>& places,
                                 std::uint64_t seed, std::uint64_t stream)
{
  if (order == PlaceOrder::Random)
  {
    return PartsByChance(places.size(), seed, stream);
  }
  Vec3 middle = Vec3::Zero();
  for (const OrderedPlace& place : places)
  {
    middle += place.Position / static_cast<double>(places.size());
  }
  std::vector<double> keys;
  for (const OrderedPlace& place : places)
  {
    keys.push_back(KeyOf(order, place, middle));
  }
  return PartsByKey(keys);
}

std::vector<double> PartsByGroup(const std::vector<int>& groups, TimeSpread within)
{
  std::map<int, std::size_t> sizes; // of each so far
  std::vector<std::size_t> ranks;
  for (const int group : groups)
  {
    ranks.push_back(sizes[group]++);
  }
  std::vector<double> parts;
  for (std::size_t i = 0; i < groups.size(); ++i)
  {
    const auto own = sizes.find(groups[i]);
    const auto before = static_cast<double>(std::distance(sizes.begin(), own));
    parts.push_back((before + SpreadOf(within, PartOfRank(ranks[i], own->second))) /
                    static_cast<double>(sizes.size()));
  }
  return parts;
}

} // namespace waft
