// SPDX-License-Identifier: BSD-3-Clause
// An air for the optimiser's tests.
#pragma once

#include "Base/FieldSeries.h"

#include <cmath>

namespace waft
{

/// A slow turn about the vertical through the middle of a box, along its walls, which gets faster.
inline Vec3 Turning(const Box& box, const Vec3& x, double time)
{
  const Vec3 at = M_PI * (x - box.Min).cwiseQuotient(box.Size());
  const double speed = (0.8 + 0.2 * time) * box.Width();
  return speed *
         Vec3(std::sin(at.x()) * std::cos(at.y()), -std::cos(at.x()) * std::sin(at.y()), 0.0) /
         M_PI;
}

/// Its series; step: of a frame [s].
inline FieldSeries TurningAir(const Box& bounds, int frames, double step)
{
  FieldSeries air;
  air.Meaning = FieldMeaning::Velocity;
  air.Dimensions = { 17, 17, 3 };
  air.Origin = bounds.Min;
  air.Spacing = bounds.Size().cwiseQuotient(Vec3(16.0, 16.0, 2.0));
  for (int frame = 0; frame < frames; ++frame)
  {
    air.Times.push_back(frame * step);
    air.Values.emplace_back();
    for (int k = 0; k < 3; ++k)
    {
      for (int j = 0; j < 17; ++j)
      {
        for (int i = 0; i < 17; ++i)
        {
          const Vec3 x = air.Origin + air.Spacing.cwiseProduct(Vec3(i, j, k));
          const Vec3 u = Turning(bounds, x, frame * step);
          air.Values.back().push_back(
            { static_cast<float>(u[0]), static_cast<float>(u[1]), static_cast<float>(u[2]) });
        }
      }
    }
  }
  return air;
}

} // namespace waft
