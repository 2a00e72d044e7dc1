// SPDX-License-Identifier: BSD-3-Clause
// Where the values of a field are: points in rows along the axes of the world.
#pragma once

#include "Base/Result.h"
#include "Base/Types.h"

#include <array>
#include <string>

namespace waft
{

/// Points Origin + (i, j, k) * Spacing [m], i fastest. Of a grid these are the centres of its
/// voxels.
struct PointLattice
{
  std::array<int, 3> Dimensions{ 0, 0, 0 };
  Vec3 Origin = Vec3::Zero();
  Vec3 Spacing = Vec3::Ones();

  std::size_t NumberOfPoints() const
  {
    return static_cast<std::size_t>(this->Dimensions[0]) * this->Dimensions[1] *
           this->Dimensions[2];
  }
  Vec3 PointAt(std::size_t index) const
  {
    const auto nx = static_cast<std::size_t>(this->Dimensions[0]);
    const auto ny = static_cast<std::size_t>(this->Dimensions[1]);
    const Vec3 cell(static_cast<double>(index % nx), static_cast<double>(index / nx % ny),
                    static_cast<double>(index / nx / ny));
    return this->Origin + cell.cwiseProduct(this->Spacing);
  }
};

/// Fails unless it has 1 to 2^30 points and a spacing and an origin within the limits of lengths
/// and coordinates; name: whose it is.
Result CheckLattice(const std::string& name, const PointLattice& lattice);

} // namespace waft
