// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>

namespace waft
{

/// The quintic step from 0 at x = 0 to 1 at x = 1, flat to second order at both ends; constant
/// beyond them.
inline double SmoothStep(double x)
{
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * t * (10.0 + t * (6.0 * t - 15.0));
}

/// The cubic one, flat to first order at both ends, for x from 0 to 1.
inline double CubicStep(double x)
{
  return x * x * (3.0 - 2.0 * x);
}

} // namespace waft
