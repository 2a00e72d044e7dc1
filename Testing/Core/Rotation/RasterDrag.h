// SPDX-License-Identifier: BSD-3-Clause
// Drag of a body pixel by pixel, what its panels are held against.
#pragma once

#include "Rotation/Rasteriser.h"

namespace waft::fixtures
{

/// Paper, Eq. 5 per pixel: drag 0.5 cd rho |w|^2 dA against w, the velocity of that piece of
/// surface relative to the air, w = relativeVelocity + gradient r. All in body axes.
inline Wrench RasterDrag(const RasterView& view, const Vec3& relativeVelocity, const Mat3& gradient,
                         double dragCoefficient, double airDensity)
{
  Wrench total;
  const double factor = 0.5 * dragCoefficient * airDensity * view.PixelArea();
  for (int j = 0; j < view.Resolution; ++j)
  {
    for (int i = 0; i < view.Resolution; ++i)
    {
      const std::size_t pixel = static_cast<std::size_t>(j) * view.Resolution + i;
      if (view.TriangleIds[pixel] < 0)
      {
        continue;
      }
      const Vec3 r = (view.MinU + (i + 0.5) * view.StepU) * view.AxisU +
                     (view.MinV + (j + 0.5) * view.StepV) * view.AxisV +
                     view.Depths[pixel] * view.Direction;
      const Vec3 w = relativeVelocity + gradient * r;
      const Vec3 force = -factor * w.norm() * w;
      total.Force += force;
      total.Torque += r.cross(force);
    }
  }
  return total;
}

} // namespace waft::fixtures
