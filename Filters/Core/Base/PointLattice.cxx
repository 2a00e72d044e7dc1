// SPDX-License-Identifier: BSD-3-Clause
#include "Base/PointLattice.h"

#include "Base/Limits.h"

namespace waft
{

Result CheckLattice(const std::string& name, const PointLattice& lattice)
{
  constexpr double most = 1 << 30; // points
  const std::array<int, 3>& n = lattice.Dimensions;
  const Vec3 size(n[0], n[1], n[2]);
  if (size.minCoeff() < 1.0 || size.prod() > most)
  {
    return Result::Error(name + ": expected a lattice of 1 to 2^30 points, found " +
                         std::to_string(n[0]) + " x " + std::to_string(n[1]) + " x " +
                         std::to_string(n[2]));
  }
  if (!limits::Length.HoldsAll(lattice.Spacing) || !limits::Coordinate.HoldsAll(lattice.Origin))
  {
    return Result::Error(name + ": expected a lattice with a spacing that is " +
                         limits::Length.Text() + " and an origin within 1e6 m, found spacing " +
                         PointText(lattice.Spacing) + ", origin " + PointText(lattice.Origin));
  }
  return Result::Ok();
}

} // namespace waft
