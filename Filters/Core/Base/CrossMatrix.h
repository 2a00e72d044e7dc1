// SPDX-License-Identifier: BSD-3-Clause
// The cross product as a matrix.
#pragma once

#include "Base/Types.h"

namespace waft
{

/// The matrix that takes v to a x v.
inline Mat3 CrossMatrix(const Vec3& a)
{
  Mat3 m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}

} // namespace waft
