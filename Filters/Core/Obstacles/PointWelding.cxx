// SPDX-License-Identifier: BSD-3-Clause
#include "Obstacles/PointWelding.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <unordered_map>

namespace waft
{

std::vector<int> EqualPoints(const std::vector<Vec3>& points)
{
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto less = [&](int l, int r)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      if (points[l][axis] != points[r][axis])
      {
        return points[l][axis] < points[r][axis];
      }
    }
    return l < r;
  };
  std::sort(order.begin(), order.end(), less);
  std::vector<int> representative(points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const bool same = i > 0 && points[order[i]] == points[order[i - 1]];
    representative[order[i]] = same ? representative[order[i - 1]] : order[i];
  }
  return representative;
}

std::vector<int> NearPoints(const std::vector<Vec3>& points, double tolerance)
{
  std::unordered_multimap<std::uint64_t, int> cells;
  const auto key = [](const Eigen::Matrix<std::int64_t, 3, 1>& cell)
  {
    return static_cast<std::uint64_t>(cell.x()) * 73856093u ^
           static_cast<std::uint64_t>(cell.y()) * 19349663u ^
           static_cast<std::uint64_t>(cell.z()) * 83492791u;
  };
  std::vector<int> representative(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vec3& p = points[i];
    const Eigen::Matrix<std::int64_t, 3, 1> cell =
      (p / (2.0 * tolerance)).array().floor().cast<std::int64_t>();
    int found = static_cast<int>(i);
    for (int n = 0; n < 27; ++n)
    {
      const Eigen::Matrix<std::int64_t, 3, 1> shift(n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1);
      const auto range = cells.equal_range(key(cell + shift));
      for (auto it = range.first; it != range.second; ++it)
      {
        if ((points[it->second] - p).norm() <= tolerance)
        {
          found = std::min(found, it->second);
        }
      }
    }
    representative[i] = found;
    if (found == static_cast<int>(i))
    {
      cells.emplace(key(cell), found);
    }
  }
  return representative;
}

double SeamTolerance(const std::vector<Vec3>& points)
{
  Eigen::AlignedBox3d bounds;
  for (const Vec3& p : points)
  {
    bounds.extend(p);
  }
  if (bounds.isEmpty())
  {
    return 1e-300;
  }
  const double farthest = std::max(bounds.min().cwiseAbs().maxCoeff(), bounds.max().maxCoeff());
  return std::max({ 1e-9 * bounds.diagonal().norm(), 1e-15 * farthest, 1e-300 });
}

} // namespace waft
