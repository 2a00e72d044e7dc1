// SPDX-License-Identifier: BSD-3-Clause
// Moves of single frames that come and go smoothly in the frames around.
#pragma once

#include "Base/SmoothStep.h"
#include "Base/Types.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace waft
{

/// own: a move of each frame [m]. Each reaches `reach` frames to either side, less and less; where
/// several meet the largest counts.
inline std::vector<Vec3> SpreadPushes(const std::vector<Vec3>& own, int reach)
{
  constexpr double Least = 1e-12; // m
  std::vector<Vec3> spread = own;
  const int last = static_cast<int>(own.size()) - 1;
  for (int k = 0; k <= last; ++k)
  {
    for (int i = std::max(0, k - reach); i <= std::min(last, k + reach); ++i)
    {
      const double fraction = SmoothStep(1.0 - std::abs(i - k) / (reach + 1.0));
      const double size = fraction * own[k].norm();
      if (size > spread[i].norm() && size > Least)
      {
        spread[i] = fraction * own[k];
      }
    }
  }
  return spread;
}

} // namespace waft
