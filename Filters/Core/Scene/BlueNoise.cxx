// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/BlueNoise.h"

#include "Base/Random.h"

#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace waft
{

namespace
{

struct Neighbour
{
  std::uint32_t Index;
  float Weight;
};

using Cell = std::array<long, 3>;

struct CellHash
{
  std::size_t operator()(const Cell& cell) const
  {
    return static_cast<std::size_t>(cell[0]) * 73856093u ^
           static_cast<std::size_t>(cell[1]) * 19349663u ^
           static_cast<std::size_t>(cell[2]) * 83492791u;
  }
};

// Those of all points nearer than `reach` to each of the first `count`, with Yuksel's weight (1 - d
// / reach)^8.
std::vector<std::vector<Neighbour>> Neighbours(const std::vector<Vec3>& points, std::size_t count,
                                               double reach)
{
  const auto cellOf = [&](const Vec3& p)
  {
    return Cell{ std::lround(std::floor(p.x() / reach)), std::lround(std::floor(p.y() / reach)),
                 std::lround(std::floor(p.z() / reach)) };
  };
  const auto around = [](const Cell& home, int offset)
  {
    return Cell{ home[0] + offset % 3 - 1, home[1] + offset / 3 % 3 - 1, home[2] + offset / 9 - 1 };
  };
  std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> cells;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Cell home = cellOf(points[i]);
    cells[home].push_back(static_cast<std::uint32_t>(i));
    for (int offset = 0; count < points.size() && offset < 27; ++offset)
    {
      cells[around(home, offset)]; // those of others that count
    }
  }
  for (std::size_t i = count; i < points.size(); ++i)
  {
    const auto cell = cells.find(cellOf(points[i]));
    if (cell != cells.end())
    {
      cell->second.push_back(static_cast<std::uint32_t>(i));
    }
  }
  std::vector<std::vector<Neighbour>> neighbours(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    const Cell home = cellOf(points[i]);
    for (int offset = 0; offset < 27; ++offset)
    {
      const auto cell = cells.find(around(home, offset));
      if (cell == cells.end())
      {
        continue;
      }
      for (const std::uint32_t j : cell->second)
      {
        const double d = (points[i] - points[j]).norm();
        if (j != i && d < reach)
        {
          neighbours[i].push_back({ j, static_cast<float>(std::pow(1.0 - d / reach, 8)) });
        }
      }
    }
  }
  return neighbours;
}

// Points by how crowded they are, in a heap: the worst on top, of equal ones the last.
class Crowd
{
public:
  explicit Crowd(std::vector<double> crowding) :
    Crowding(std::move(crowding)), Heap(this->Crowding.size()), PlaceOf(this->Crowding.size())
  {
    std::iota(this->Heap.begin(), this->Heap.end(), 0);
    std::iota(this->PlaceOf.begin(), this->PlaceOf.end(), 0);
    for (std::size_t place = this->Heap.size() / 2; place-- > 0;)
    {
      this->Sink(place);
    }
  }

  std::size_t Count() const { return this->Heap.size(); }

  std::uint32_t TakeWorst()
  {
    const std::uint32_t worst = this->Heap.front();
    const std::uint32_t last = this->Heap.back();
    this->Heap.pop_back();
    if (!this->Heap.empty())
    {
      this->Put(last, 0);
      this->Sink(0);
    }
    return worst;
  }

  void Relieve(std::uint32_t point, double weight)
  {
    this->Crowding[point] -= weight;
    this->Sink(this->PlaceOf[point]);
  }

private:
  bool IsWorse(std::uint32_t a, std::uint32_t b) const
  {
    return this->Crowding[a] > this->Crowding[b] ||
           (this->Crowding[a] == this->Crowding[b] && a > b);
  }
  void Put(std::uint32_t point, std::size_t place)
  {
    this->Heap[place] = point;
    this->PlaceOf[point] = static_cast<std::uint32_t>(place);
  }
  void Sink(std::size_t place)
  {
    const std::uint32_t point = this->Heap[place];
    for (std::size_t below = 2 * place + 1; below < this->Heap.size(); below = 2 * place + 1)
    {
      if (below + 1 < this->Heap.size() && this->IsWorse(this->Heap[below + 1], this->Heap[below]))
      {
        ++below;
      }
      if (!this->IsWorse(this->Heap[below], point))
      {
        break;
      }
      this->Put(this->Heap[below], place);
      place = below;
    }
    this->Put(point, place);
  }

  std::vector<double> Crowding;
  std::vector<std::uint32_t> Heap;    // points
  std::vector<std::uint32_t> PlaceOf; // by point
};

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
    const auto neighbours = Neighbours(all, candidates.size(), spacing);
    std::vector<double> crowding(candidates.size(), 0.0);
    for (std::size_t i = 0; i < candidates.size(); ++i)
    {
      for (const Neighbour& neighbour : neighbours[i])
      {
        crowding[i] += neighbour.Weight;
      }
    }
    Crowd crowd(std::move(crowding));
    while (crowd.Count() > count)
    {
      const std::uint32_t worst = crowd.TakeWorst();
      kept[worst] = 0;
      for (const Neighbour& neighbour : neighbours[worst])
      {
        if (neighbour.Index < candidates.size() && kept[neighbour.Index])
        {
          crowd.Relieve(neighbour.Index, neighbour.Weight);
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
  constexpr std::size_t mostTries = 4000000;
  constexpr std::size_t mostInVain = 20000; // without a single place there are not `count`
  Random random(seed, stream);
  std::vector<Vec3> candidates;
  const std::size_t wanted = std::max<std::size_t>(candidatesPerPoint * count, 64);
  const std::size_t most = std::min(wanted * triesPerCandidate, mostTries);
  std::size_t tried = 0;
  for (; tried < (candidates.empty() ? std::min(most, mostInVain) : most) &&
         candidates.size() < wanted;
       ++tried)
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
