// SPDX-License-Identifier: BSD-3-Clause
// Solids as open parts of faces, and how fields go on into them.
#pragma once

#include "Grid/SmokeOptions.h"
#include "Grid/StaggeredLayout.h"

#include <array>
#include <cstdint>
#include <vector>

namespace waft
{

/// The faces of a grid with solids given by signed distances at its nodes (cut cells: a face lets
/// through the part of it that is outside, Ng, Min, Gibou 2009).
class SolidFaces
{
public:
  /// distances and velocities as for SmokeSolver::SetSolids; sizes are the caller's concern.
  void Build(const StaggeredLayout& layout, const SmokeOptions& options,
             const std::vector<float>& distances,
             const std::vector<std::array<float, 3>>& velocities);

  /// Open part of each face, 0..1; 0 on closed ends.
  const std::vector<float>& Fractions(int axis) const { return this->Open[axis]; }
  bool HasSolids() const { return this->Any; }
  bool HasMovingSolids() const { return !this->FaceVelocity[0].empty(); }
  /// 1 where the centre of a cell is in a solid (staggered layout, cell centres).
  const std::vector<unsigned char>& CenterIsSolid() const { return this->InSolid; }

  /// Carries face velocities some layers into the solids, as means of known neighbours, less their
  /// part through the surface.
  void ExtendVelocities(const std::array<float*, 3>& faces) const;
  /// Carries a cell-centred field into the solids.
  void ExtendCells(float* cells) const;
  /// Velocity of the solid at a closed face of an axis [m/s], as a normal component.
  float ClosedVelocity(int axis, std::ptrdiff_t p) const
  {
    return this->HasMovingSolids() ? this->FaceVelocity[axis][p] : 0.0f;
  }
  /// Divergence that the solids' own movement feeds into the cells [1/s], in the staggered layout.
  const std::vector<float>& SolidDivergence() const { return this->Swept; }

private:
  struct Link
  {
    std::ptrdiff_t At;
    unsigned char Neighbours; // bits: -x, +x, -y, +y, -z, +z
    std::array<float, 3> Normal{ 0.0f, 0.0f, 0.0f };
  };
  float Node(const std::vector<float>& distances, int i, int j, int k) const;
  void CutFaces(const SmokeOptions& options, const std::vector<float>& distances);
  void MoveFaces(const SmokeOptions& options, const std::vector<std::array<float, 3>>& velocities);
  std::vector<Link> MakeLinks(int faceAxis, const std::vector<unsigned char>& known,
                              const SmokeOptions& options,
                              const std::vector<float>& distances) const;
  void Extend(const std::vector<Link>& links, float* values) const;

  StaggeredLayout Layout;
  bool Any = false;
  std::array<std::vector<float>, 3> Open;
  std::array<std::vector<float>, 3> FaceVelocity; // empty when nothing moves
  std::vector<float> Swept;
  std::vector<unsigned char> InSolid;
  std::array<std::vector<Link>, 3> FaceLinks;
  std::vector<Link> CellLinks;
};

} // namespace waft
