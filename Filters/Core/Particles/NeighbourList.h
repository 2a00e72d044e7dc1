// SPDX-License-Identifier: BSD-3-Clause
// Verlet lists with a skin: valid until a particle has moved half the skin.
#pragma once

#include "Particles/SphKernels.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace waft
{

/// Work space of a list's construction, one a thread.
struct NeighbourScratch
{
  std::vector<std::uint32_t> CellStarts, CellOf, Next, Found;
  std::vector<float> X, Y, Z;
};

/// Neighbour lists of one frame, each pair once: a pair of gas particles is listed at one of the
/// two, a pair of gas and object at the object. Particles from numberOfGas on belong to objects and
/// do not see each other. Two bytes an entry up to 65535 particles, four beyond.
/// The lists speak of slots: the gas by cells of the reach's size, so that what is near in space
/// is near in memory however the gas has mixed, then the objects' particles as they are numbered.
class NeighbourList
{
public:
  /// x, y, z: n coordinates; reach: support plus skin.
  void Build(const SphKernelTable& kernels, std::size_t n, std::size_t numberOfGas, const float* x,
             const float* y, const float* z, float reach, NeighbourScratch& scratch);
  /// Builds again when a particle has moved half the skin since the last time. The skin adapts:
  /// wider while particles move far from one call to the next, narrower once they settle. What it
  /// is depends on the calls so far, the sums over the lists do not.
  void Update(const SphKernelTable& kernels, std::size_t n, std::size_t numberOfGas, const float* x,
              const float* y, const float* z, float support, NeighbourScratch& scratch);
  /// True when a particle has moved farther than `distance` since Build, or nothing was built.
  bool IsStale(const float* x, const float* y, const float* z, float distance) const;

  /// By slot.
  SphNeighbours View() const;
  /// The particle in each slot.
  const std::vector<std::uint32_t>& Order() const { return this->Particles; }
  std::size_t NumberOfEntries() const
  {
    return this->Starts.empty() ? 0 : 8 * static_cast<std::size_t>(this->Starts.back());
  }

private:
  void Append(const NeighbourScratch& scratch, std::size_t found);

  std::size_t Count = 0;
  float Skin = 0.2f;            // [dx]
  int Uses = 0;                 // calls of Update since Build
  std::vector<float> Reference; // positions at Build, three rows
  std::vector<std::uint32_t> Particles;
  std::vector<std::uint32_t> Starts;
  std::vector<std::uint16_t> Narrow;
  std::vector<std::uint32_t> Wide;
};

} // namespace waft
