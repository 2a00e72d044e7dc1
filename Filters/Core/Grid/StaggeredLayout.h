// SPDX-License-Identifier: BSD-3-Clause
// The layout of every array of the smoke solver, and the ghosts around it.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace waft
{

/// Arrays of n + 1 samples along each axis with two ghosts at either end, so that faces (n + 1
/// along their own axis) and cell centres (n) have one layout and a cubic stencil needs no
/// branches. Face (i, j, k) of axis a is the one of cell (i, j, k) towards the axis's lower end.
struct StaggeredLayout
{
  static constexpr int Ghosts = 2;
  std::array<int, 3> N{ 0, 0, 0 };
  std::ptrdiff_t StrideY = 0;
  std::ptrdiff_t StrideZ = 0;

  StaggeredLayout() = default;
  explicit StaggeredLayout(const std::array<int, 3>& n) :
    N(n), StrideY((n[0] + 1 + 2 * Ghosts + 7) / 8 * 8), StrideZ(StrideY * (n[1] + 1 + 2 * Ghosts))
  {
  }
  /// With room for one vector past the last sample.
  std::size_t Size() const
  {
    return static_cast<std::size_t>(this->StrideZ) * (this->N[2] + 1 + 2 * Ghosts) + 8;
  }
  std::ptrdiff_t Index(int i, int j, int k) const
  {
    return (k + Ghosts) * this->StrideZ + (j + Ghosts) * this->StrideY + (i + Ghosts);
  }
  std::ptrdiff_t Stride(int axis) const
  {
    return axis == 0 ? 1 : axis == 1 ? this->StrideY : this->StrideZ;
  }
  /// Samples along an axis of an array that lives on the faces of `faceAxis` (-1: cell centres).
  int Count(int axis, int faceAxis) const { return this->N[axis] + (axis == faceAxis ? 1 : 0); }
};

/// What lies beyond the two ends of each axis.
enum class EndKind : unsigned char
{
  Wall,    // ghosts repeat the last sample
  Outside, // ghosts are what is outside: still, clean air, or a breeze
  Wrap     // ghosts are the samples of the other end
};
using AxisEnds = std::array<std::array<EndKind, 2>, 3>;

/// Fills the ghosts of an array on the faces of faceAxis (-1: cell centres).
void FillGhosts(const StaggeredLayout& layout, const AxisEnds& ends, int faceAxis, float* values,
                float outside = 0.0f);

} // namespace waft
