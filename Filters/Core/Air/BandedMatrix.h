// SPDX-License-Identifier: BSD-3-Clause
// A symmetric positive definite matrix whose entries lie near its diagonal, and its Cholesky
// factors.
#pragma once

#include <algorithm>
#include <cmath>
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

  /// In place; false where the matrix is not positive definite. Column by column, what follows it
  /// is changed at once: sums that do not wait for each other.
  bool Factor()
  {
    std::vector<double> column(this->Width);
    for (std::size_t j = 0; j < this->N; ++j)
    {
      double& diagonal = this->Row(j)[j];
      if (!(diagonal > 0.0))
      {
        return false;
      }
      diagonal = 1.0 / std::sqrt(diagonal); // kept as its inverse
      const std::size_t end = std::min(this->N, j + this->Width);
      for (std::size_t i = j + 1; i < end; ++i)
      {
        column[i - j] = this->Row(i)[j] *= diagonal;
        double* row = this->Row(i) + j;
        for (std::size_t m = 1; m <= i - j; ++m)
        {
          row[m] -= column[i - j] * column[m];
        }
      }
    }
    return true;
  }
  /// Of the factors, in place.
  void Solve(std::vector<double>& b)
  {
    for (std::size_t j = 0; j < this->N; ++j)
    {
      b[j] *= this->Row(j)[j];
      const std::size_t end = std::min(this->N, j + this->Width);
      for (std::size_t i = j + 1; i < end; ++i)
      {
        b[i] -= this->Row(i)[j] * b[j];
      }
    }
    for (std::size_t i = this->N; i-- > 0;)
    {
      const double* row = this->Row(i);
      b[i] *= row[i];
      for (std::size_t k = this->First(i); k < i; ++k)
      {
        b[k] -= row[k] * b[i];
      }
    }
  }

private:
  std::size_t First(std::size_t i) const { return i + 1 > this->Width ? i + 1 - this->Width : 0; }
  /// So that column j is at [j].
  double* Row(std::size_t i) { return this->Values.data() + (i + 1) * this->Width - 1 - i; }

  std::size_t N, Width;
  std::vector<double> Values;
};

} // namespace waft
