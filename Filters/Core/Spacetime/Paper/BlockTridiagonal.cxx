// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Paper/BlockTridiagonal.h"

#include "Base/FractionDone.h"

#include <Eigen/Cholesky>

#include <vector>

namespace waft
{

bool BlockTridiagonal::Solve(Eigen::MatrixXd& right, Monitor* monitor) const
{
  const std::size_t blocks = this->NumberOfBlocks;
  const Eigen::Index size = right.rows() / static_cast<Eigen::Index>(blocks);
  const auto part = [&](std::size_t k)
  { return right.middleRows(static_cast<Eigen::Index>(k) * size, size); };
  std::vector<Eigen::LLT<Eigen::MatrixXd>> factors;
  std::vector<Eigen::MatrixXd> beside; // the factor's blocks above its diagonal
  for (std::size_t k = 0; k < blocks; ++k)
  {
    if (monitor && !monitor->Tick(FractionDone(k, blocks), {}))
    {
      return false;
    }
    Eigen::MatrixXd own = this->Diagonal(k);
    auto rows = part(k);
    if (k > 0)
    {
      own.selfadjointView<Eigen::Lower>().rankUpdate(beside[k - 1].transpose(), -1.0);
      rows -= beside[k - 1].transpose() * part(k - 1);
    }
    factors.emplace_back(std::move(own));
    factors[k].matrixL().solveInPlace(rows);
    if (k + 1 < blocks)
    {
      beside.push_back(this->Upper(k));
      factors[k].matrixL().solveInPlace(beside[k]);
    }
  }
  for (std::size_t k = blocks; k-- > 0;)
  {
    auto rows = part(k);
    if (k + 1 < blocks)
    {
      rows -= beside[k] * part(k + 1);
    }
    factors[k].matrixU().solveInPlace(rows);
  }
  return true;
}

} // namespace waft
