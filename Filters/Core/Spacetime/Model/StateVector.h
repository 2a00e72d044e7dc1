// SPDX-License-Identifier: BSD-3-Clause
// Long vectors of unknowns, one block a frame, and their arithmetic: parallel over blocks, sums in
// the order of the blocks.
#pragma once

#include "Base/Parallel.h"
#include "Base/Types.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace waft
{

using StateVector = std::vector<float>;

/// A body's place or velocity: p is its first component, the others follow a stride apart each.
inline Vec3 VectorAt(const float* p, std::size_t stride)
{
  return Vec3(p[0], p[stride], p[2 * stride]);
}

inline void SetVector(float* p, std::size_t stride, const Vec3& value)
{
  for (int c = 0; c < 3; ++c)
  {
    p[c * stride] = static_cast<float>(value[c]);
  }
}

class VectorSpace
{
public:
  VectorSpace(std::size_t blocks, std::size_t blockSize, const ParallelFor& parallel) :
    Blocks(blocks), BlockSize(blockSize), Parallel(parallel)
  {
  }

  std::size_t Size() const { return this->Blocks * this->BlockSize; }
  double Dot(const StateVector& a, const StateVector& b) const;
  /// y += factor x
  void Add(double factor, const StateVector& x, StateVector& y) const;
  /// y += factor x; returns y . z
  double AddDot(double factor, const StateVector& x, StateVector& y, const StateVector& z) const;
  /// out = a + factor b
  void Combine(const StateVector& a, double factor, const StateVector& b, StateVector& out) const;
  void Scale(double factor, StateVector& x) const;

private:
  double Sum(const std::function<double(std::size_t, std::size_t)>& blockSum) const;

  void ForElements(const std::function<void(std::size_t, std::size_t)>& range) const;

  std::size_t Blocks, BlockSize;
  ParallelFor Parallel;
};

} // namespace waft
