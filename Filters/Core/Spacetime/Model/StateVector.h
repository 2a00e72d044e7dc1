// SPDX-License-Identifier: BSD-3-Clause
// Long vectors of unknowns, one block a frame, and their arithmetic: parallel over a rank's own
// blocks, sums in the order of all blocks.
#pragma once

#include "Base/Parallel.h"
#include "Spacetime/Model/FramePartition.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace waft
{

using StateVector = std::vector<float>;

class VectorSpace
{
public:
  VectorSpace(const FramePartition& partition, std::size_t blockSize, const ParallelFor& parallel) :
    Partition(partition), BlockSize(blockSize), Parallel(parallel)
  {
  }

  /// Of a vector, frames that are held and not owned included: these keep what they are.
  std::size_t Size() const { return this->Partition.Held().Size() * this->BlockSize; }
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

  FramePartition Partition;
  std::size_t BlockSize;
  ParallelFor Parallel;
};

} // namespace waft
