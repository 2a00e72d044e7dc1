// SPDX-License-Identifier: BSD-3-Clause
// Numbers and points as messages have them.
#pragma once

#include "Base/Types.h"

#include <cstdio>
#include <string>

namespace waft
{

/// At most so many significant digits, as few as will do: 0.05, 1.2e-07.
inline std::string NumberText(double x, int digits = 4)
{
  char text[64];
  std::snprintf(text, sizeof(text), "%.*g", digits, x);
  return text;
}

/// "(x, y, z)"
inline std::string PointText(const Vec3& p)
{
  return "(" + NumberText(p.x(), 6) + ", " + NumberText(p.y(), 6) + ", " + NumberText(p.z(), 6) +
         ")";
}

/// "at frame 7", "at frames 7 to 10"
inline std::string FramesText(int first, int last)
{
  return first == last ? "at frame " + std::to_string(first)
                       : "at frames " + std::to_string(first) + " to " + std::to_string(last);
}

} // namespace waft
