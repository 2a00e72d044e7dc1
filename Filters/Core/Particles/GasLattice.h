// SPDX-License-Identifier: BSD-3-Clause
// Gas at rest: a lattice that fills the volume.
#pragma once

#include "Base/Result.h"
#include "Base/Types.h"
#include "Particles/SphFluid.h"

#include <array>
#include <vector>

namespace waft
{

/// A lattice of gas particles at the centres of equal cells of a box.
struct GasLattice
{
  Box Bounds; // m
  std::array<int, 3> Dimensions{ 0, 0, 0 };
  double Spacing = 1.0; // dx = (volume / cells)^(1/3) [m]

  /// The numbers of cells whose product is nearest to `count` with nearly cubic cells.
  static GasLattice Make(const Box& bounds, int count);
  static GasLattice Make(const Box& bounds, const std::array<int, 3>& dimensions);

  /// Fails on fewer than three layers each way: gas so thin has no neighbours to push.
  Result CheckLayers() const;
  /// Cell centres in units of dx from Bounds.Min, x fastest.
  std::vector<Vec3> Points() const;
  Vec3 SizeInSpacings() const { return this->Bounds.Size() / this->Spacing; }
  /// The particle mass that gives density one in the inner lattice.
  double ParticleMass(const SphFluid& fluid) const;
};

} // namespace waft
