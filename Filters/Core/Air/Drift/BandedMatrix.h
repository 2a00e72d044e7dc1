// SPDX-License-Identifier: BSD-3-Clause
// A symmetric positive definite matrix whose entries lie near its diagonal, and its Cholesky
// factors.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace waft
{

class BandedMatrix
{
public:
  /// Rows i and columns j with |i - j| <= halfBand.
  BandedMatrix(std::size_t size, std::size_t halfBand) :
    N(size), Width(halfBand + 1), Values(size * (halfBand + 1), 0.0)
  {
  }

  std::size_t Size() const { return this->N; }
  void Clear() { std::fill(this->Values.begin(), this->Values.end(), 0.0); }
  /// i - halfBand <= j <= i: the lower half is what is stored.
  double& At(std::size_t i, std::size_t j) { return this->Row(i)[j]; }

  /// y = this x, before it is factored.
  void Multiply(const std::vector<double>& x, std::vector<double>& y) const;
  /// In place; false where the matrix is not positive definite.
  bool Factor();
  /// Of the factors, in place.
  void Solve(std::vector<double>& b) const;

private:
  /// So that column j is at [j].
  double* Row(std::size_t i) { return this->Values.data() + (i + 1) * this->Width - 1 - i; }

  std::size_t N, Width;
  std::vector<double> Values;
};

} // namespace waft
