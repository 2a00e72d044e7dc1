// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Model/LevelTransfer.h"

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
  for (const DifferenceRow& row : table.Rows)
  {
    for (const DifferenceRow::Term& term : row.Terms)
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
  const std::size_t half = size / 2;
  StateVector coarse(level.NumberOfFrames() * size);
  for (std::size_t j = 0; j < level.NumberOfFrames(); ++j)
  {
    const float* source = full.data() + level.Frames[j] * size;
    float* out = coarse.data() + j * size;
    std::copy(source, source + size, out);
    for (std::size_t i = 0; i < half && j > 0; ++i)
    {
      out[half + i] = (out[i] - out[i - size]) / static_cast<float>(level.Steps[j]);
    }
  }
  return coarse;
}

void Prolong(const SpacetimeModel& model, const TimeLevel& level, const StateVector& coarse,
             StateVector& full)
{
  const std::size_t size = model.FrameSize();
  const std::size_t half = size / 2;
  const std::size_t last = level.NumberOfFrames() - 1;
  std::copy(coarse.begin(), coarse.begin() + static_cast<std::ptrdiff_t>(size), full.begin());
  for (std::size_t j = 1; j <= last; ++j)
  {
    // Cubic Hermite with central slopes over the four level frames about this step.
    const std::size_t before = j > 1 ? j - 2 : 0;
    const std::size_t after = std::min(j + 1, last);
    const float* p[4] = { coarse.data() + before * size, coarse.data() + (j - 1) * size,
                          coarse.data() + j * size, coarse.data() + after * size };
    const float step = static_cast<float>(level.Steps[j]);
    const float left = step / static_cast<float>(level.Frames[j] - level.Frames[before]);
    const float right = step / static_cast<float>(level.Frames[after] - level.Frames[j - 1]);
    // Velocities differ from the differences by what XSPH and residuals put between them.
    const float* velocity = p[2] + half;
    for (int frame = level.Frames[j - 1] + 1; frame <= level.Frames[j]; ++frame)
    {
      const float t = static_cast<float>(frame - level.Frames[j - 1]) / step;
      const float h1 = t * t * (3.0f - 2.0f * t);
      const float g0 = t * (1.0f - t) * (1.0f - t) * left;
      const float g1 = -t * t * (1.0f - t) * right;
      float* out = full.data() + frame * size;
      const float* previous = out - size;
      for (std::size_t i = 0; i < half; ++i)
      {
        out[i] =
          p[1][i] + h1 * (p[2][i] - p[1][i]) + g0 * (p[2][i] - p[0][i]) + g1 * (p[3][i] - p[1][i]);
        out[half + i] = (out[i] - previous[i]) + (velocity[i] - (p[2][i] - p[1][i]) / step);
      }
    }
  }
}

} // namespace waft
