// SPDX-License-Identifier: BSD-3-Clause
#include "Grid/StaggeredLayout.h"
#include <algorithm>
#include <vector>

namespace waft
{
namespace
{

// The sample that a ghost copies; -1: what is outside.
int SourceOf(int at, int count, int period, const std::array<EndKind, 2>& ends)
{
  const EndKind end = at < 0 ? ends[0] : ends[1];
  switch (end)
  {
    case EndKind::Wall:
      return at < 0 ? 0 : count - 1;
    case EndKind::Wrap:
      return ((at % period) + period) % period;
    case EndKind::Outside:
      break;
  }
  return -1;
}

// A slice across an axis that is copied from another, or set to what is outside.
struct Copy
{
  int To, From; // From < 0: outside
};

void CopySlice(const StaggeredLayout& layout, int axis, const Copy& copy, float outside,
               float* values)
{
  constexpr int g = StaggeredLayout::Ghosts;
  std::array<int, 3> low{ -g, -g, -g };
  std::array<int, 3> high{ layout.N[0] + g, layout.N[1] + g, layout.N[2] + g };
  low[axis] = high[axis] = copy.To;
  const std::ptrdiff_t shift = (copy.From - copy.To) * layout.Stride(axis);
  for (int k = low[2]; k <= high[2]; ++k)
  {
    for (int j = low[1]; j <= high[1]; ++j)
    {
      float* row = values + layout.Index(0, j, k);
      for (int i = low[0]; i <= high[0]; ++i)
      {
        row[i] = copy.From < 0 ? outside : row[i + shift];
      }
    }
  }
}

// All slices across x at once: each row is fetched once.
void CopyAlongRows(const StaggeredLayout& layout, const std::vector<Copy>& copies, float outside,
                   float* values)
{
  constexpr int g = StaggeredLayout::Ghosts;
  for (int k = -g; k <= layout.N[2] + g; ++k)
  {
    for (int j = -g; j <= layout.N[1] + g; ++j)
    {
      float* row = values + layout.Index(0, j, k);
      for (const Copy& copy : copies)
      {
        row[copy.To] = copy.From < 0 ? outside : row[copy.From];
      }
    }
  }
}

} // namespace

void FillGhosts(const StaggeredLayout& layout, const AxisEnds& ends, int faceAxis, float* values,
                float outside)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const int n = layout.N[axis];
    const int count = layout.Count(axis, faceAxis);
    // On a periodic axis the last face is the first one.
    const int first = ends[axis][1] == EndKind::Wrap ? n : count;
    std::vector<Copy> copies;
    for (int g = 1; g <= StaggeredLayout::Ghosts; ++g)
    {
      copies.push_back({ -g, SourceOf(-g, count, n, ends[axis]) });
    }
    for (int at = first; at <= n + StaggeredLayout::Ghosts; ++at)
    {
      copies.push_back({ at, SourceOf(at, count, n, ends[axis]) });
    }
    if (axis == 0)
    {
      CopyAlongRows(layout, copies, outside, values);
      continue;
    }
    for (const Copy& copy : copies)
    {
      CopySlice(layout, axis, copy, outside, values);
    }
  }
}

} // namespace waft
