// SPDX-License-Identifier: BSD-3-Clause
// Signed distance to closed surfaces on a regular lattice.
#pragma once

#include "Base/Types.h"

#include <array>
#include <vector>

namespace waft
{

/// Signed distances [m] at Origin + (i, j, k) * Spacing, i fastest; negative inside. Values beyond
/// Band are clamped to +-Band.
struct DistanceLattice
{
  std::array<int, 3> Dimensions{ 0, 0, 0 };
  Vec3 Origin = Vec3::Zero();
  double Spacing = 1.0; // m, the same along each axis
  double Band = 0.0;    // m
  std::vector<float> Values;

  bool IsEmpty() const { return this->Values.empty(); }
  /// Trilinear value, clamped to the lattice.
  double Sample(const Vec3& x) const;
  /// The same and the gradient of the trilinear interpolant (zero where clamped).
  double Sample(const Vec3& x, Vec3& gradient) const;
};

} // namespace waft
