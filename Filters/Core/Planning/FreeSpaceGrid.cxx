// SPDX-License-Identifier: BSD-3-Clause
#include "Planning/FreeSpaceGrid.h"

#include "Planning/ClearanceField.h"
#include "Planning/PlannerNumbers.h"

#include <algorithm>
#include <cmath>
#include <queue>

namespace waft
{

FreeSpaceGrid::FreeSpaceGrid(const ObstacleSet& obstacles, const Box& bounds, double clearance,
                             int cells, const std::atomic<bool>& stop) :
  Obstacles(obstacles),
  Stop(stop), Bounds(bounds), Clearance(clearance)
{
  const Vec3 size = bounds.Size();
  this->Spacing = bounds.Width() / cells;
  for (int i = 0; i < 3; ++i)
  {
    this->Counts[i] =
      std::clamp(static_cast<int>(std::ceil(size[i] / this->Spacing)), 1, 2 * cells);
  }
  this->Room.resize(static_cast<std::size_t>(this->Counts[0]) * this->Counts[1] * this->Counts[2]);
  ClearanceField field;
  field.Obstacles = &obstacles;
  field.Bounds = bounds;
  // More room than this makes no way better.
  const double enough = std::max(PlannerNumbers::EnoughSpacings * this->Spacing,
                                 PlannerNumbers::EnoughRadii * clearance);
  Cell cell;
  for (cell[2] = 0; cell[2] < this->Counts[2] && !stop; ++cell[2])
  {
    for (cell[1] = 0; cell[1] < this->Counts[1]; ++cell[1])
    {
      for (cell[0] = 0; cell[0] < this->Counts[0]; ++cell[0])
      {
        this->Room[this->Index(cell)] =
          static_cast<float>(field.Distance(this->Center(cell), 0.0, enough));
      }
    }
  }
}

std::size_t FreeSpaceGrid::Index(const Cell& cell) const
{
  return static_cast<std::size_t>(cell[0]) +
         static_cast<std::size_t>(this->Counts[0]) *
           (static_cast<std::size_t>(cell[1]) +
            static_cast<std::size_t>(this->Counts[1]) * static_cast<std::size_t>(cell[2]));
}

Vec3 FreeSpaceGrid::Center(const Cell& cell) const
{
  const Vec3 size = this->Bounds.Size();
  return this->Bounds.Min + Vec3((cell[0] + 0.5) * size.x() / this->Counts[0],
                                 (cell[1] + 0.5) * size.y() / this->Counts[1],
                                 (cell[2] + 0.5) * size.z() / this->Counts[2]);
}

bool FreeSpaceGrid::NearestFree(const Vec3& x, Cell& nearest) const
{
  const Vec3 size = this->Bounds.Size();
  Cell home;
  for (int i = 0; i < 3; ++i)
  {
    home[i] = std::clamp(static_cast<int>((x[i] - this->Bounds.Min[i]) / size[i] * this->Counts[i]),
                         0, this->Counts[i] - 1);
  }
  double best = 1e300;
  Cell cell;
  const int reach = PlannerNumbers::EntryCells;
  for (cell[2] = std::max(0, home[2] - reach);
       cell[2] <= std::min(this->Counts[2] - 1, home[2] + reach); ++cell[2])
  {
    for (cell[1] = std::max(0, home[1] - reach);
         cell[1] <= std::min(this->Counts[1] - 1, home[1] + reach); ++cell[1])
    {
      for (cell[0] = std::max(0, home[0] - reach);
           cell[0] <= std::min(this->Counts[0] - 1, home[0] + reach); ++cell[0])
      {
        const Vec3 center = this->Center(cell);
        const double distance = (center - x).squaredNorm();
        // Not through a wall: straight from the mark to the cell.
        if (this->Room[this->Index(cell)] >= this->Clearance && distance < best &&
            this->Obstacles.IsClear(x, 0.0, center, 0.0, 0.0))
        {
          best = distance;
          nearest = cell;
        }
      }
    }
  }
  return best < 1e300;
}

bool FreeSpaceGrid::IsPassable(const Cell& a, const Cell& b) const
{
  const double roomA = this->Room[this->Index(a)];
  const double roomB = this->Room[this->Index(b)];
  if (roomA < this->Clearance || roomB < this->Clearance)
  {
    return false;
  }
  const Vec3 from = this->Center(a);
  const Vec3 to = this->Center(b);
  // Balls that overlap cover the way between; else a thin wall may stand there.
  return roomA + roomB > (to - from).norm() + this->Clearance ||
         this->Obstacles.IsClear(from, 0.0, to, 0.0,
                                 PlannerNumbers::SightFraction * this->Clearance);
}

std::vector<Vec3> FreeSpaceGrid::FindWay(const Vec3& a, const Vec3& b) const
{
  Cell start;
  Cell goal;
  if (!this->NearestFree(a, start) || !this->NearestFree(b, goal))
  {
    return {};
  }
  std::vector<float> length(this->Room.size(), 1e30f);
  std::vector<int> from(this->Room.size(), -1);
  using Entry = std::pair<float, int>; // (estimated length, cell): ties go to the lower cell
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> open;
  const auto cellOf = [&](int index)
  {
    return Cell{ index % this->Counts[0], (index / this->Counts[0]) % this->Counts[1],
                 index / (this->Counts[0] * this->Counts[1]) };
  };
  const Vec3 target = this->Center(goal);
  length[this->Index(start)] = 0.0f;
  open.emplace(0.0f, static_cast<int>(this->Index(start)));
  const auto goalIndex = static_cast<int>(this->Index(goal));
  std::vector<char> isDone(this->Room.size(), 0);
  while (!open.empty() && !this->Stop)
  {
    const int index = open.top().second;
    open.pop();
    if (index == goalIndex)
    {
      break;
    }
    if (isDone[index] != 0)
    {
      continue;
    }
    isDone[index] = 1;
    const Cell cell = cellOf(index);
    for (int step = 0; step < 27; ++step)
    {
      const Cell next{ cell[0] + step % 3 - 1, cell[1] + (step / 3) % 3 - 1,
                       cell[2] + step / 9 - 1 };
      if (step == 13 || next[0] < 0 || next[1] < 0 || next[2] < 0 || next[0] >= this->Counts[0] ||
          next[1] >= this->Counts[1] || next[2] >= this->Counts[2])
      {
        continue;
      }
      const std::size_t nextIndex = this->Index(next);
      const Vec3 center = this->Center(next);
      // A little detour for more room.
      const double narrow = this->Clearance / std::max<double>(this->Room[nextIndex], 1e-6);
      const auto sum =
        static_cast<float>(length[index] + (center - this->Center(cell)).norm() *
                                             (1.0 + PlannerNumbers::NarrowDetour * narrow));
      if (isDone[nextIndex] == 0 && sum < length[nextIndex] && this->IsPassable(cell, next))
      {
        length[nextIndex] = sum;
        from[nextIndex] = index;
        open.emplace(sum + static_cast<float>((target - center).norm()),
                     static_cast<int>(nextIndex));
      }
    }
  }
  if (from[goalIndex] < 0 && goalIndex != static_cast<int>(this->Index(start)))
  {
    return {};
  }
  std::vector<Vec3> way{ b };
  for (int index = goalIndex; index >= 0; index = from[index])
  {
    way.push_back(this->Center(cellOf(index)));
  }
  way.push_back(a);
  std::reverse(way.begin(), way.end());
  return way;
}

Vec3 PointAlong(const std::vector<Vec3>& way, double fraction)
{
  double total = 0.0;
  for (std::size_t k = 1; k < way.size(); ++k)
  {
    total += (way[k] - way[k - 1]).norm();
  }
  double left = fraction * total;
  for (std::size_t k = 1; k < way.size(); ++k)
  {
    const double step = (way[k] - way[k - 1]).norm();
    if (left <= step && step > 0.0)
    {
      return way[k - 1] + left / step * (way[k] - way[k - 1]);
    }
    left -= step;
  }
  return way.back();
}

} // namespace waft
