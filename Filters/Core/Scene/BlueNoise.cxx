// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/BlueNoise.h"

#include "Base/Random.h"

#include <array>
#include <cmath>
#include <map>
#include <set>

namespace waft
{

namespace
{

struct Neighbor
{
  std::uint32_t Index;
  float Weight;
};

// All pairs nearer than `reach`, with Yuksel's weight (1 - d / reach)^8.
std::vector<std::vector<Neighbor>> Neighbors(const std::vector<Vec3>& points, double reach)
{
  using Cell = std::array<long, 3>;
  const auto cellOf = [&](const Vec3& p)
  {
    return Cell{ std::lround(std::floor(p.x() / reach)), std::lround(std::floor(p.y() / reach)),
                 std::lround(std::floor(p.z() / reach)) };
  };
  std::map<Cell, std::vector<std::uint32_t>> cells;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    cells[cellOf(points[i])].push_back(static_cast<std::uint32_t>(i));
  }
  std::vector<std::vector<Neighbor>> neighbors(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Cell home = cellOf(points[i]);
    for (int offset = 0; offset < 27; ++offset)
    {
      const auto cell = cells.find(
        { home[0] + offset % 3 - 1, home[1] + offset / 3 % 3 - 1, home[2] + offset / 9 - 1 });
      if (cell == cells.end())
      {
        continue;
      }
      for (const std::uint32_t j : cell->second)
      {
        const double d = (points[i] - points[j]).norm();
        if (j != i && d < reach)
        {
          neighbors[i].push_back({ j, static_cast<float>(std::pow(1.0 - d / reach, 8)) });
        }
      }
    }
  }
  return neighbors;
}

} // namespace

double PackingDistance(double measure, int dimensions, std::size_t count)
{
  const double measureOfEach = measure / static_cast<double>(std::max<std::size_t>(count, 1));
  switch (dimensions)
  {
    case 3:
      return std::cbrt(std::sqrt(2.0) * measureOfEach);
    case 2:
      return std::sqrt(2.0 / std::sqrt(3.0) * measureOfEach);
    default:
      return measureOfEach;
  }
}

std::vector<std::size_t> EliminateSamples(const std::vector<Vec3>& candidates, std::size_t count,
                                          double spacing, const std::vector<Vec3>& taken)
{
  std::vector<char> kept(candidates.size(), 1);
  if (candidates.size() > count && spacing > 0.0)
  {
    std::vector<Vec3> all = candidates;
    all.insert(all.end(), taken.begin(), taken.end());
    const auto neighbors = Neighbors(all, spacing);
    std::vector<double> crowding(candidates.size(), 0.0);
    std::set<std::pair<double, std::size_t>> order; // the most crowded last
    for (std::size_t i = 0; i < candidates.size(); ++i)
    {
      for (const Neighbor& neighbor : neighbors[i])
      {
        crowding[i] += neighbor.Weight;
      }
      order.insert({ crowding[i], i });
    }
    while (order.size() > count)
    {
      const std::size_t worst = std::prev(order.end())->second;
      order.erase(std::prev(order.end()));
      kept[worst] = 0;
      for (const Neighbor& neighbor : neighbors[worst])
      {
        if (neighbor.Index < candidates.size() && kept[neighbor.Index])
        {
          order.erase({ crowding[neighbor.Index], neighbor.Index });
          crowding[neighbor.Index] -= neighbor.Weight;
          order.insert({ crowding[neighbor.Index], neighbor.Index });
        }
      }
    }
  }
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < candidates.size() && chosen.size() < count; ++i)
  {
    if (kept[i])
    {
      chosen.push_back(i);
    }
  }
  return chosen;
}

std::vector<Vec3> SpreadInBox(const Box& box, std::size_t count, std::uint64_t seed,
                              std::uint64_t stream,
                              const std::function<bool(const Vec3&)>& isAdmissible,
                              const std::vector<Vec3>& taken)
{
  constexpr std::size_t candidatesPerPoint = 16;
  constexpr std::size_t triesPerCandidate = 50;
  Random random(seed, stream);
  std::vector<Vec3> candidates;
  const std::size_t wanted = std::max<std::size_t>(candidatesPerPoint * count, 64);
  std::size_t tried = 0;
  for (; tried < wanted * triesPerCandidate && candidates.size() < wanted; ++tried)
  {
    const Vec3 x = random.InBox(box);
    if (isAdmissible(x))
    {
      candidates.push_back(x);
    }
  }
  if (candidates.empty())
  {
    return {};
  }
  double measure = static_cast<double>(candidates.size()) / static_cast<double>(tried);
  int dimensions = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    if (box.Size()[axis] > 0.0)
    {
      measure *= box.Size()[axis];
      ++dimensions;
    }
  }
  const auto sharing =
    std::count_if(taken.begin(), taken.end(), [&](const Vec3& p) { return box.Contains(p); });
  const double spacing =
    PackingDistance(measure, dimensions, count + static_cast<std::size_t>(sharing));
  std::vector<Vec3> points;
  for (const std::size_t i : EliminateSamples(candidates, count, spacing, taken))
  {
    points.push_back(candidates[i]);
  }
  return points;
}

} // namespace waft
