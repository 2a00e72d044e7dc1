// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Solver/HeldUnknowns.h"

#include <algorithm>

namespace waft
{

HeldUnknowns HoldUnknowns(const SpacetimeModel& model, const TimeLevel& level)
{
  const std::size_t no = model.NumberOfObjects;
  const std::size_t frames = level.NumberOfFrames();
  HeldUnknowns held;
  held.Objects.assign(frames * no, 0);
  held.IsPart = !level.IsFree(0) || !level.IsFree(frames - 1);
  for (std::size_t k = 0; k < held.Objects.size(); ++k)
  {
    held.Objects[k] = !level.IsFree(k / no);
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
