// SPDX-License-Identifier: BSD-3-Clause
// Symmetric positive definite matrices whose entries lie near their diagonals, and their Cholesky
// factors: one, or four side by side.
#pragma once

#include "Base/Simd.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace waft
{

/// Where four doubles lie side by side.
struct alignas(32) FourDoubles
{
  std::array<double, 4> Of{};
};
inline double* Lanes(double* values)
{
  return values;
}
inline const double* Lanes(const double* values)
{
  return values;
}
inline Double4* Lanes(FourDoubles* values)
{
  return reinterpret_cast<Double4*>(values);
}
inline const Double4* Lanes(const FourDoubles* values)
{
  return reinterpret_cast<const Double4*>(values);
}

/// Value: double, or FourDoubles: four matrices of one size and band, whose operations are done at
/// once and each in the order in which one matrix alone has them, to the same bits.
template <class Value>
class Banded
{
public:
  /// Rows i and columns j with |i - j| <= halfBand.
  Banded(std::size_t size, std::size_t halfBand) :
    N(size), Width(halfBand + 1), Values(size * (halfBand + 1), Value{})
  {
  }

  std::size_t Size() const { return this->N; }
  std::size_t HalfBand() const { return this->Width - 1; }
  void Clear() { std::fill(this->Values.begin(), this->Values.end(), Value{}); }
  /// i - halfBand <= j <= i: the lower half is what is stored.
  Value& At(std::size_t i, std::size_t j) { return this->Values[this->Place(i, j)]; }
  const Value& At(std::size_t i, std::size_t j) const { return this->Values[this->Place(i, j)]; }

  /// In place; false where the matrix, or one of them, is not positive definite.
  bool Factor();
  /// Of the factors, in place.
  void Solve(std::vector<Value>& b) const;

private:
  std::size_t Place(std::size_t i, std::size_t j) const
  {
    return (i + 1) * this->Width - 1 - i + j;
  }

  std::size_t N, Width;
  std::vector<Value> Values;
};

using BandedMatrix = Banded<double>;

} // namespace waft
