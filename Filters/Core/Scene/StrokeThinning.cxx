// SPDX-License-Identifier: BSD-3-Clause
#include "Scene/StrokeThinning.h"

#include <array>
#include <cstddef>

namespace waft
{

namespace
{

// The eight neighbours from north, clockwise; outside the raster is empty.
std::array<int, 8> NeighboursOf(const std::vector<char>& raster, int width, int height, int x,
                                int y)
{
  constexpr int dx[8] = { 0, 1, 1, 1, 0, -1, -1, -1 };
  constexpr int dy[8] = { 1, 1, 0, -1, -1, -1, 0, 1 };
  std::array<int, 8> p{};
  for (int k = 0; k < 8; ++k)
  {
    const int u = x + dx[k];
    const int v = y + dy[k];
    p[k] = u >= 0 && u < width && v >= 0 && v < height ? raster[std::size_t(v) * width + u] : 0;
  }
  return p;
}

bool IsRemovable(const std::array<int, 8>& p, bool second)
{
  int filled = 0;
  int rises = 0;
  for (int k = 0; k < 8; ++k)
  {
    filled += p[k];
    rises += p[k] == 0 && p[(k + 1) % 8] == 1;
  }
  const bool sides = second ? p[0] * p[2] * p[6] == 0 && p[0] * p[4] * p[6] == 0
                            : p[0] * p[2] * p[4] == 0 && p[2] * p[4] * p[6] == 0;
  return filled >= 2 && filled <= 6 && rises == 1 && sides;
}

} // namespace

std::vector<char> ThinStrokes(std::vector<char> raster, int width, int height)
{
  for (bool changed = true; changed;)
  {
    changed = false;
    for (const bool second : { false, true })
    {
      std::vector<std::size_t> removed;
      for (int y = 0; y < height; ++y)
      {
        for (int x = 0; x < width; ++x)
        {
          const std::size_t i = std::size_t(y) * width + x;
          if (raster[i] && IsRemovable(NeighboursOf(raster, width, height, x, y), second))
          {
            removed.push_back(i);
          }
        }
      }
      for (const std::size_t i : removed)
      {
        raster[i] = 0;
      }
      changed = changed || !removed.empty();
    }
  }
  return raster;
}

} // namespace waft
