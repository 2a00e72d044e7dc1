// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/TimeLevels.h"

#include <algorithm>

namespace waft
{

std::vector<int> CoarseFrames(const SpacetimeModel& model, const ConstraintTable& table, int stride)
{
  const int frames = model.NumberOfFrames;
  const std::size_t no = model.NumberOfObjects;
  std::vector<char> kept(frames, 0);
  kept.front() = kept.back() = 1;
  std::vector<char> bound(static_cast<std::size_t>(frames) * no, 0);
  for (std::size_t k = 0; k < bound.size(); ++k)
  {
    bound[k] = model.Flags[k] & FixedPosition ? 1 : 0;
  }
  for (const PositionBall& ball : table.Balls)
  {
    bound[static_cast<std::size_t>(ball.Frame) * no + ball.Object] = 1;
  }
  for (int frame = 1; frame + 1 < frames; ++frame)
  {
    for (std::size_t o = 0; o < no; ++o)
    {
      const std::size_t k = static_cast<std::size_t>(frame) * no + o;
      const bool inner = bound[k - no] && bound[k + no];
      kept[frame] |= bound[k] && !inner;
    }
  }
  for (const LinearRow& row : table.Rows)
  {
    for (const LinearRow::Term& term : row.Terms)
    {
      kept[term.Frame] = 1;
    }
  }
  std::vector<int> result;
  for (int frame = 0; frame < frames; ++frame)
  {
    if (!kept[frame])
    {
      continue;
    }
    while (!result.empty() && frame - result.back() > stride)
    {
      result.push_back(result.back() + stride);
    }
    result.push_back(frame);
  }
  return result;
}

StateVector Restrict(const SpacetimeModel& model, const TimeLevel& level, const StateVector& full)
{
  const std::size_t size = model.FrameSize();
  StateVector coarse(level.NumberOfFrames() * size);
  for (std::size_t j = 0; j < level.NumberOfFrames(); ++j)
  {
    const float* source = full.data() + level.Frames[j] * size;
    std::copy(source, source + size, coarse.data() + j * size);
  }
  return coarse;
}

void Prolong(const SpacetimeModel& model, const TimeLevel& level, const StateVector& coarse,
             StateVector& full)
{
  const std::size_t size = model.FrameSize();
  for (std::size_t j = 0; j < level.NumberOfFrames(); ++j)
  {
    const float* b = coarse.data() + j * size;
    const float* a = j > 0 ? b - size : b;
    const int first = j > 0 ? level.Frames[j - 1] : level.Frames[0];
    for (int frame = j > 0 ? first + 1 : first; frame <= level.Frames[j]; ++frame)
    {
      const float t =
        j > 0 ? static_cast<float>(frame - first) / static_cast<float>(level.Frames[j] - first)
              : 1.0f;
      float* out = full.data() + frame * size;
      for (std::size_t i = 0; i < size; ++i)
      {
        out[i] = (1.0f - t) * a[i] + t * b[i];
      }
    }
  }
}

} // namespace waft
