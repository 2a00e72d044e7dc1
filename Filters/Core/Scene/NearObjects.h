// SPDX-License-Identifier: BSD-3-Clause
// Objects by where they are: is there room for one more? Private to this library.
#pragma once

#include "Base/Types.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace waft
{

/// Balls in the cells of a grid. The cells grow with the balls, so that a query looks at few.
class NearObjects
{
public:
  std::size_t Count() const { return this->Balls.size(); }

  void Add(const Vec3& center, double radius)
  {
    this->Balls.push_back({ center, radius });
    this->Largest = std::max(this->Largest, radius);
    if (4.0 * this->Largest > this->Side)
    {
      this->Side = 8.0 * this->Largest;
      this->Cells.clear();
      for (std::size_t i = 0; i < this->Balls.size(); ++i)
      {
        this->Cells[Key(this->CellOf(this->Balls[i].Center))].push_back(i);
      }
    }
    else if (this->Side > 0.0)
    {
      this->Cells[Key(this->CellOf(center))].push_back(this->Balls.size() - 1);
    }
  }

  /// Whether a ball here would meet none of those that were added.
  bool HasRoom(const Vec3& center, double radius) const
  {
    const double reach = radius + this->Largest;
    if (reach == 0.0)
    {
      return true;
    }
    if (!(reach <= this->Side)) // a ball among much smaller ones
    {
      return std::all_of(this->Balls.begin(), this->Balls.end(),
                         [&](const Ball& ball) { return ball.IsApart(center, radius); });
    }
    const Cell home = this->CellOf(center);
    for (int offset = 0; offset < 27; ++offset)
    {
      const auto cell = this->Cells.find(
        Key({ home[0] + offset % 3 - 1, home[1] + offset / 3 % 3 - 1, home[2] + offset / 9 - 1 }));
      if (cell != this->Cells.end() &&
          !std::all_of(cell->second.begin(), cell->second.end(),
                       [&](std::size_t i) { return this->Balls[i].IsApart(center, radius); }))
      {
        return false;
      }
    }
    return true;
  }

private:
  using Cell = std::array<std::int64_t, 3>;
  struct Ball
  {
    Vec3 Center;
    double Radius;

    bool IsApart(const Vec3& center, double radius) const
    {
      return !((this->Center - center).norm() < radius + this->Radius);
    }
  };

  Cell CellOf(const Vec3& x) const
  {
    const auto index = [this](double value)
    { return static_cast<std::int64_t>(std::floor(std::clamp(value / this->Side, -1e15, 1e15))); };
    return { index(x.x()), index(x.y()), index(x.z()) };
  }
  /// Cells that share a key only cost time.
  static std::uint64_t Key(const Cell& cell)
  {
    return static_cast<std::uint64_t>(cell[0]) * 73856093u ^
           static_cast<std::uint64_t>(cell[1]) * 19349663u ^
           static_cast<std::uint64_t>(cell[2]) * 83492791u;
  }

  std::vector<Ball> Balls;
  double Largest = 0.0;
  double Side = 0.0; // of a cell [m]
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> Cells;
};

} // namespace waft
