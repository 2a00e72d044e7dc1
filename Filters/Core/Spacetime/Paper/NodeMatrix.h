// SPDX-License-Identifier: BSD-3-Clause
// Symmetric matrices over the nodes of a lattice of quadratic B-splines: two nodes have an entry
// where both are in one stencil, two apart at most along each axis.
#pragma once

#include "Spacetime/Model/SplineWind.h"

#include <Eigen/SparseCore>

#include <array>
#include <vector>

namespace waft
{

class NodeMatrix
{
public:
  explicit NodeMatrix(const SplineWind& shape) :
    Dimensions(shape.Dimensions), Values(shape.NumberOfNodes() * Width, 0.0)
  {
  }

  void Clear() { std::fill(this->Values.begin(), this->Values.end(), 0.0); }
  /// Of a node and another, each step from it -2 to 2. Those in earlier lines than the node's own
  /// (k, then j below 0) are not read: the matrix is symmetric.
  double& At(std::size_t node, int i, int j, int k) { return this->Values[Place(node, i, j, k)]; }
  double At(std::size_t node, int i, int j, int k) const
  {
    return this->Values[Place(node, i, j, k)];
  }
  /// The stencil's outer product.
  void AddRow(const SplineWind& shape, const SplineStencil& stencil, double weight);
  void Add(const NodeMatrix& other, double factor);
  void AddToDiagonal(double value);
  /// The same for each of three components, interleaved.
  Eigen::SparseMatrix<double, Eigen::RowMajor> OfVectors() const;
  /// Adds to a vector, of three components a node, a column of that matrix.
  void AddColumn(std::size_t column, double factor, Eigen::VectorXd& sum) const;

private:
  static constexpr std::size_t Width = 125;
  static std::size_t Place(std::size_t node, int i, int j, int k)
  {
    return node * Width + static_cast<std::size_t>(((k + 2) * 5 + j + 2) * 5 + i + 2);
  }
  std::array<int, 3> Dimensions;
  std::vector<double> Values;
};

} // namespace waft
