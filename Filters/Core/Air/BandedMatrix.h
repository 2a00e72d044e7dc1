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

  /// In place; false where the matrix is not positive definite.
  bool Factor()
  {
    for (std::size_t i = 0; i < this->N; ++i)
    {
      double* row = this->Row(i);
      for (std::size_t j = this->First(i); j <= i; ++j)
      {
        const double* other = this->Row(j);
        double sum = row[j];
        for (std::size_t k = this->First(i); k < j; ++k)
        {
          sum -= row[k] * other[k];
        }
        if (j < i)
        {
          row[j] = sum * this->InverseDiagonal(j);
        }
        else if (sum > 0.0)
        {
          row[i] = 1.0 / std::sqrt(sum); // kept as its inverse
        }
        else
        {
          return false;
        }
      }
    }
    return true;
  }
  /// Of the factors, in place.
  void Solve(std::vector<double>& b)
  {
    for (std::size_t i = 0; i < this->N; ++i)
    {
      const double* row = this->Row(i);
      for (std::size_t k = this->First(i); k < i; ++k)
      {
        b[i] -= row[k] * b[k];
      }
      b[i] *= row[i];
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
  double InverseDiagonal(std::size_t j) { return this->Row(j)[j]; }

  std::size_t N, Width;
  std::vector<double> Values;
};

} // namespace waft
