// SPDX-License-Identifier: BSD-3-Clause
#include "Particles/NeighbourList.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <type_traits>
#include <utility>

namespace waft
{
namespace
{

struct CellGrid
{
  float Min[3];
  float Inverse;
  int Size[3];

  int Index(int axis, float p) const
  {
    const int cell = static_cast<int>((p - this->Min[axis]) * this->Inverse);
    return std::clamp(cell, 0, this->Size[axis] - 1);
  }
};

CellGrid MakeGrid(std::size_t n, const float* const points[3], float reach)
{
  CellGrid grid;
  float extent = 0.0f;
  for (int a = 0; a < 3; ++a)
  {
    const auto range = std::minmax_element(points[a], points[a] + n);
    grid.Min[a] = *range.first;
    extent = std::max(extent, *range.second - *range.first);
    grid.Size[a] = static_cast<int>(std::min(128.0f, (*range.second - *range.first) / reach)) + 1;
  }
  // Cells never smaller than the reach, also when an extent was cut to 128 cells.
  grid.Inverse = 1.0f / std::max(reach, extent / 128.0f);
  return grid;
}

} // namespace

void NeighbourList::Build(const SphKernelTable& kernels, std::size_t n, std::size_t numberOfGas,
                          const float* x, const float* y, const float* z, float reach,
                          NeighbourScratch& scratch)
{
  const float* points[3] = { x, y, z };
  this->Count = n;
  this->Reference.clear();
  this->Reference.reserve(3 * n);
  for (const float* row : points)
  {
    this->Reference.insert(this->Reference.end(), row, row + n);
  }
  const CellGrid grid = MakeGrid(n, points, reach);
  const std::size_t cells = static_cast<std::size_t>(grid.Size[0]) * grid.Size[1] * grid.Size[2];

  // Counting sort of the gas by cell, x fastest: the three cells along x are one range.
  const std::size_t gas = std::min(n, numberOfGas);
  scratch.CellStarts.assign(cells + 1, 0);
  scratch.CellOf.resize(gas);
  for (std::size_t i = 0; i < gas; ++i)
  {
    const int cell = (grid.Index(2, z[i]) * grid.Size[1] + grid.Index(1, y[i])) * grid.Size[0] +
                     grid.Index(0, x[i]);
    scratch.CellOf[i] = static_cast<std::uint32_t>(cell);
    ++scratch.CellStarts[cell + 1];
  }
  for (std::size_t c = 0; c < cells; ++c)
  {
    scratch.CellStarts[c + 1] += scratch.CellStarts[c];
  }
  this->Particles.resize(n);
  scratch.Next.assign(scratch.CellStarts.begin(), scratch.CellStarts.end() - 1);
  for (std::size_t i = 0; i < gas; ++i)
  {
    this->Particles[scratch.Next[scratch.CellOf[i]]++] = static_cast<std::uint32_t>(i);
  }
  std::iota(this->Particles.begin() + static_cast<std::ptrdiff_t>(gas), this->Particles.end(),
            static_cast<std::uint32_t>(gas));
  std::vector<float>* sorted[3] = { &scratch.X, &scratch.Y, &scratch.Z };
  for (int a = 0; a < 3; ++a)
  {
    sorted[a]->resize(n + 8);
    for (std::size_t k = 0; k < n; ++k)
    {
      (*sorted[a])[k] = points[a][this->Particles[k]];
    }
  }

  this->Starts.assign(n + 1, 0);
  this->Narrow.clear();
  this->Wide.clear();
  scratch.Found.resize(gas + 16);
  for (std::size_t i = 0; i < n; ++i)
  {
    const float p[3] = { scratch.X[i], scratch.Y[i], scratch.Z[i] };
    // Gas looks at the gas behind itself, objects at all.
    const std::size_t from = i < gas ? i + 1 : 0;
    std::size_t count = 0;
    const int cx = grid.Index(0, p[0]), cy = grid.Index(1, p[1]), cz = grid.Index(2, p[2]);
    for (int k = i < gas ? cz : std::max(0, cz - 1); k <= std::min(grid.Size[2] - 1, cz + 1); ++k)
    {
      for (int j = std::max(0, cy - 1); j <= std::min(grid.Size[1] - 1, cy + 1); ++j)
      {
        const std::size_t row = (static_cast<std::size_t>(k) * grid.Size[1] + j) * grid.Size[0];
        const std::size_t begin =
          std::max<std::size_t>(from, scratch.CellStarts[row + std::max(0, cx - 1)]);
        const std::size_t end = scratch.CellStarts[row + std::min(grid.Size[0] - 1, cx + 1) + 1];
        if (begin < end)
        {
          count += kernels.Near(scratch.X.data(), scratch.Y.data(), scratch.Z.data(), begin, end, p,
                                reach * reach, scratch.Found.data() + count);
        }
      }
    }
    this->Append(scratch, count);
    this->Starts[i + 1] = this->Starts[i] + static_cast<std::uint32_t>((count + 7) / 8);
  }
}

// The slots found, filled up to a group of eight with the far one.
void NeighbourList::Append(const NeighbourScratch& scratch, std::size_t found)
{
  const auto append = [&](auto& list)
  {
    using Index = typename std::decay_t<decltype(list)>::value_type;
    const std::size_t first = list.size();
    list.resize(first + (found + 7) / 8 * 8, static_cast<Index>(this->Count));
    for (std::size_t f = 0; f < found; ++f)
    {
      list[first + f] = static_cast<Index>(scratch.Found[f]);
    }
  };
  this->Count < std::numeric_limits<std::uint16_t>::max() ? append(this->Narrow)
                                                          : append(this->Wide);
}

void NeighbourList::Update(const SphKernelTable& kernels, std::size_t n, std::size_t numberOfGas,
                           const float* x, const float* y, const float* z, float support,
                           NeighbourScratch& scratch)
{
  // A list costs little more to build than an evaluation of its sums.
  constexpr int FewUses = 5;
  constexpr int ManyUses = 15;
  constexpr float NarrowestSkin = 0.1f;
  constexpr float WidestSkin = 0.5f;
  if (!this->IsStale(x, y, z, 0.5f * this->Skin))
  {
    ++this->Uses;
    return;
  }
  if (this->Count > 0 && this->Uses < FewUses)
  {
    this->Skin = std::min(WidestSkin, 1.4f * this->Skin);
  }
  else if (this->Uses > ManyUses)
  {
    this->Skin = std::max(NarrowestSkin, 0.8f * this->Skin);
  }
  this->Uses = 0;
  this->Build(kernels, n, numberOfGas, x, y, z, support + this->Skin, scratch);
}

bool NeighbourList::IsStale(const float* x, const float* y, const float* z, float distance) const
{
  const std::size_t n = this->Count;
  if (n == 0)
  {
    return true;
  }
  const float* rx = this->Reference.data();
  const float* ry = rx + n;
  const float* rz = ry + n;
  float largest = 0.0f;
  for (std::size_t i = 0; i < n; ++i)
  {
    const float dx = x[i] - rx[i];
    const float dy = y[i] - ry[i];
    const float dz = z[i] - rz[i];
    const float d2 = dx * dx + dy * dy + dz * dz;
    largest = largest > d2 ? largest : d2;
  }
  return !(largest <= distance * distance);
}

SphNeighbours NeighbourList::View() const
{
  const bool narrow = this->Wide.empty();
  return { this->Starts.data(), narrow ? this->Narrow.data() : nullptr,
           narrow ? nullptr : this->Wide.data() };
}

} // namespace waft
