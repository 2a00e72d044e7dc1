// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Solver/HeldUnknowns.h"

#include <algorithm>

namespace waft
{

HeldUnknowns HoldUnknowns(const SpacetimeModel& model, const TimeLevel& level,
                          const std::vector<char>& movable)
{
  const std::size_t no = model.NumberOfObjects;
  const std::size_t frames = level.NumberOfFrames();
  HeldUnknowns held;
  held.Objects.assign(frames * no, 0);
  held.IsPart = !movable.empty() || !level.IsFree(0) || !level.IsFree(frames - 1);
  for (std::size_t k = 0; k < held.Objects.size(); ++k)
  {
    const bool moves = movable.empty() || movable[model.NumberOfGas + k % no];
    held.Objects[k] = !moves || !level.IsFree(k / no);
  }
  for (std::size_t i = 0; i < model.NumberOfGas && !movable.empty(); ++i)
  {
    if (!movable[i])
    {
      held.Gas.push_back(i);
    }
  }
  return held;
}

void ClearHeld(const SpacetimeModel& model, const TimeLevel& level, const HeldUnknowns& held,
               StateVector& direction)
{
  const std::size_t size = model.FrameSize();
  const std::size_t no = model.NumberOfObjects;
  for (std::size_t j = 0; j < level.NumberOfFrames() && held.IsPart; ++j)
  {
    float* frame = direction.data() + j * size;
    if (!level.IsFree(j))
    {
      std::fill(frame, frame + size, 0.0f);
      continue;
    }
    for (std::size_t row = 0; row < size; row += model.Stride())
    {
      for (const std::size_t i : held.Gas)
      {
        frame[row + i] = 0.0f;
      }
      for (std::size_t o = 0; o < no; ++o)
      {
        if (held.Objects[j * no + o])
        {
          frame[row + model.NumberOfGas + o] = 0.0f;
        }
      }
    }
  }
}

} // namespace waft
