// SPDX-License-Identifier: BSD-3-Clause
// The level sets of OpenVDB.
#pragma once

#include "Base/Mesh.h"
#include "Obstacles/DistanceLattice.h"

#include <algorithm>

namespace waft
{

/// A block of a lattice's points: Low[axis] <= index < End[axis]; values over it are i fastest.
struct LatticeWindow
{
  std::array<int, 3> Low{ 0, 0, 0 };
  std::array<int, 3> End{ 0, 0, 0 };

  int Size(int axis) const { return std::max(0, this->End[axis] - this->Low[axis]); }
  std::size_t NumberOfPoints() const
  {
    return static_cast<std::size_t>(this->Size(0)) * this->Size(1) * this->Size(2);
  }
  /// body(i, j, k), in the order of the values.
  template <typename Body>
  void ForEachPoint(const Body& body) const
  {
    for (int k = this->Low[2]; k < this->End[2]; ++k)
    {
      for (int j = this->Low[1]; j < this->End[1]; ++j)
      {
        for (int i = this->Low[0]; i < this->End[0]; ++i)
        {
          body(i, j, k);
        }
      }
    }
  }
};

/// Distances [m] of the window's points to a surface displaced by offset, without sign, at most
/// lattice.Band plus one spacing (openvdb::tools::meshToVolume). They are upper bounds of the true
/// distances, some tenths of a spacing too large where they are too large. Throws what OpenVDB
/// throws.
void UnsignedNarrowBand(const TriangleMesh& mesh, const Vec3& offset,
                        const DistanceLattice& lattice, const LatticeWindow& window,
                        std::vector<float>& distance);

} // namespace waft
