// SPDX-License-Identifier: BSD-3-Clause
// What is missing to density one where the gas lies at rest on its lattice, as a smooth field.
#pragma once

#include "Base/Types.h"
#include "Particles/GasLattice.h"
#include "Particles/SphFluid.h"
#include "Particles/SphKernels.h"

#include <array>
#include <vector>

namespace waft
{

/// The walls' and obstacles' part of the density is an integral over a continuum, the gas about it
/// a sum over particles: beside a surface the two do not make one by some percent, and gas at rest
/// would be pushed about. This field is what each site of the lattice lacks. Between sites it is
/// blended by the quintic 6 u^5 - 15 u^4 + 10 u^3 along each axis, whose first and second
/// derivatives vanish at the sites: it is C2, and leaves stiffness about the lattice as it is. One
/// more layer of sites beyond the walls mirrors it with the opposite sign, so that it is zero at
/// them, where the continuum is right.
class RestDensity
{
public:
  /// isThere: whether the lattice's sites, x fastest, hold gas; surfaces: density that walls and
  /// obstacles give there. Sites without gas take the mean of their neighbours.
  void Build(const GasLattice& lattice, const SphFluid& fluid, const std::vector<char>& isThere,
             const std::vector<double>& surfaces);
  /// The whole lattice of a box without obstacles.
  void Build(const GasLattice& lattice, const SphFluid& fluid);

  bool IsEmpty() const { return this->Values.empty(); }
  /// At x (dx from the corner of the box).
  double Evaluate(const Vec3& x, Vec3& gradient, Mat3& hessian) const;
  SphRestField View() const;

private:
  static void FillGaps(const std::array<int, 3>& cells, std::vector<char> isKnown,
                       std::vector<double>& values);
  void Mirror(const std::vector<double>& inside);

  std::array<int, 3> Dimensions{ 0, 0, 0 }; // with the layers beyond the walls
  Vec3 Cell = Vec3::Ones();                 // dx
  std::vector<double> Values;               // a site, x fastest
  std::vector<float> Rounded;
};

} // namespace waft
