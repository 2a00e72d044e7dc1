// SPDX-License-Identifier: BSD-3-Clause
#include "Grid/StaggeredLayout.h"

#include <algorithm>

namespace waft
{
namespace
{

// The sample that a ghost copies; -1: zero.
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

void CopySlice(const StaggeredLayout& layout, int axis, int to, int from, float* values)
{
  constexpr int g = StaggeredLayout::Ghosts;
  std::array<int, 3> low{ -g, -g, -g };
  std::array<int, 3> high{ layout.N[0] + g, layout.N[1] + g, layout.N[2] + g };
  low[axis] = high[axis] = to;
  const std::ptrdiff_t shift = (from - to) * layout.Stride(axis);
  for (int k = low[2]; k <= high[2]; ++k)
  {
    for (int j = low[1]; j <= high[1]; ++j)
    {
      float* row = values + layout.Index(0, j, k);
      for (int i = low[0]; i <= high[0]; ++i)
      {
        row[i] = from < 0 ? 0.0f : row[i + shift];
      }
    }
  }
}

} // namespace

void FillGhosts(const StaggeredLayout& layout, const AxisEnds& ends, int faceAxis, float* values)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const int n = layout.N[axis];
    const int count = layout.Count(axis, faceAxis);
    // On a periodic axis the last face is the first one.
    const int first = ends[axis][1] == EndKind::Wrap ? n : count;
    for (int g = 1; g <= StaggeredLayout::Ghosts; ++g)
    {
      CopySlice(layout, axis, -g, SourceOf(-g, count, n, ends[axis]), values);
    }
    for (int at = first; at <= n + StaggeredLayout::Ghosts; ++at)
    {
      CopySlice(layout, axis, at, SourceOf(at, count, n, ends[axis]), values);
    }
  }
}

} // namespace waft
