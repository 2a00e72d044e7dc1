// SPDX-License-Identifier: BSD-3-Clause
// Symmetric positive definite systems of blocks in a row, of which each is bound to its neighbours.
#pragma once

#include "Base/Monitor.h"

#include <Eigen/Core>

#include <cstddef>
#include <functional>

namespace waft
{

struct BlockTridiagonal
{
  /// Blocks of one size, made when their turn comes: of a place, whose lower half is read, and of
  /// it and the next.
  using MakeBlock = std::function<Eigen::MatrixXd(std::size_t)>;
  std::size_t NumberOfBlocks = 0;
  MakeBlock Diagonal, Upper;

  /// Cholesky's factorisation, block by block. right: one column a system, its rows those of all
  /// blocks; the solutions are left in it. False: the monitor stopped it.
  bool Solve(Eigen::MatrixXd& right, Monitor* monitor = nullptr) const;
};

} // namespace waft
