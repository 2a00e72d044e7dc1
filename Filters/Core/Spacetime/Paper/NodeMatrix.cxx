// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Paper/NodeMatrix.h"

#include <algorithm>

namespace waft
{

void NodeMatrix::AddRow(const SplineWind& shape, const SplineStencil& stencil, double weight)
{
  std::array<double, 27> w;
  for (std::size_t k = 0; k < 3; ++k)
  {
    for (std::size_t j = 0; j < 3; ++j)
    {
      for (std::size_t i = 0; i < 3; ++i)
      {
        w[(k * 3 + j) * 3 + i] = static_cast<double>(stencil.Weights[0][i]) *
                                 stencil.Weights[1][j] * stencil.Weights[2][k];
      }
    }
  }
  const std::array<int, 3>& first = stencil.First;
  for (int n = 0; n < 27; ++n)
  {
    const int i = n % 3, j = n / 3 % 3, k = n / 9;
    const double own = weight * w[static_cast<std::size_t>(n)];
    // Of the stencil's first node, seen from this one.
    double* line = &this->At(shape.Node(first[0] + i, first[1] + j, first[2] + k), -i, -j, -k);
    // From this node's own line on: what is before it is told by symmetry.
    for (std::size_t m = static_cast<std::size_t>(n) / 3 * 3; m < 27; m += 3)
    {
      double* at = line + m / 9 * 25 + m / 3 % 3 * 5;
      at[0] += own * w[m];
      at[1] += own * w[m + 1];
      at[2] += own * w[m + 2];
    }
  }
}

void NodeMatrix::Add(const NodeMatrix& other, double factor)
{
  for (std::size_t i = 0; i < this->Values.size(); ++i)
  {
    this->Values[i] += factor * other.Values[i];
  }
}

void NodeMatrix::AddToDiagonal(double value)
{
  for (std::size_t at = Width / 2; at < this->Values.size(); at += Width)
  {
    this->Values[at] += value;
  }
}

void NodeMatrix::AddColumn(std::size_t column, double factor, Eigen::VectorXd& sum) const
{
  const auto& n = this->Dimensions;
  const int node = static_cast<int>(column / 3);
  const int here[3] = { node % n[0], node / n[0] % n[1], node / n[0] / n[1] };
  for (int k = std::max(-2, -here[2]); k <= std::min(2, n[2] - 1 - here[2]); ++k)
  {
    for (int j = std::max(-2, -here[1]); j <= std::min(2, n[1] - 1 - here[1]); ++j)
    {
      const bool isAfter = k > 0 || (k == 0 && j > 0); // told by the column's own node
      for (int i = std::max(-2, -here[0]); i <= std::min(2, n[0] - 1 - here[0]); ++i)
      {
        const int other = node + (k * n[1] + j) * n[0] + i;
        const double value = isAfter ? this->At(static_cast<std::size_t>(node), i, j, k)
                                     : this->At(static_cast<std::size_t>(other), -i, -j, -k);
        sum[static_cast<Eigen::Index>(3 * other) + static_cast<Eigen::Index>(column % 3)] +=
          factor * value;
      }
    }
  }
}

Eigen::SparseMatrix<double, Eigen::RowMajor> NodeMatrix::OfVectors() const
{
  const auto& n = this->Dimensions;
  const auto size = static_cast<Eigen::Index>(3 * this->Values.size() / Width);
  Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(size, size);
  std::vector<Eigen::Triplet<double>> entries;
  std::size_t at = 0;
  for (int k = 0; k < n[2]; ++k)
  {
    for (int j = 0; j < n[1]; ++j)
    {
      for (int i = 0; i < n[0]; ++i)
      {
        const Eigen::Index row = (static_cast<Eigen::Index>(k) * n[1] + j) * n[0] + i;
        for (std::size_t m = 0; m < Width; ++m, ++at)
        {
          const bool isBefore = m / 5 < Width / 10; // in an earlier line than the node's own
          if (this->Values[at] == 0.0 || isBefore)
          {
            continue;
          }
          const int di = static_cast<int>(m % 5) - 2;
          const int dj = static_cast<int>(m / 5 % 5) - 2;
          const int dk = static_cast<int>(m / 25) - 2;
          const Eigen::Index column = row + (static_cast<Eigen::Index>(dk) * n[1] + dj) * n[0] + di;
          for (int c = 0; c < 3; ++c)
          {
            entries.emplace_back(3 * row + c, 3 * column + c, this->Values[at]);
            if (m / 5 > Width / 10)
            {
              entries.emplace_back(3 * column + c, 3 * row + c, this->Values[at]);
            }
          }
        }
      }
    }
  }
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

} // namespace waft
