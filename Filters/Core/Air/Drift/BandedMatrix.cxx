// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift/BandedMatrix.h"

#include <array>
#include <cmath>
#include <utility>

namespace waft
{
namespace
{

constexpr std::size_t UsualBand = 8; // of drift

// Functions for every processor and for AVX2 are not templates: these are what they have in common.

WAFT_INLINE bool IsPositive(const double& value)
{
  return value > 0.0;
}

WAFT_INLINE bool IsPositive(const Double4& values)
{
  return values[0] > 0.0 && values[1] > 0.0 && values[2] > 0.0 && values[3] > 0.0;
}

WAFT_INLINE void InvertRoot(double& value)
{
  value = 1.0 / std::sqrt(value);
}

WAFT_INLINE void InvertRoot(Double4& values)
{
  Double4 roots;
  for (int l = 0; l < 4; ++l)
  {
    roots[l] = std::sqrt(values[l]);
  }
  values = 1.0 / roots;
}

// The entry (i, j) is at [Band * i + Band + j]: those of a column are `Band` apart, those of a row
// side by side. Column by column, what follows it is changed at once: sums that do not wait for
// each other.

template <std::size_t Row, std::size_t Band, class Value>
WAFT_INLINE void ChangeRow(const std::array<Value, Band + 1>& column, Value* diagonal)
{
  for (std::size_t m = 1; m <= Row; ++m)
  {
    diagonal[Row * Band + m] -= column[Row] * column[m];
  }
}

template <std::size_t Band, class Value, std::size_t... Rows>
WAFT_INLINE void EliminateColumn(Value* diagonal, std::index_sequence<Rows...>)
{
  InvertRoot(*diagonal); // kept as its inverse
  const Value inverse = *diagonal;
  std::array<Value, Band + 1> column;
  ((column[Rows + 1] = diagonal[(Rows + 1) * Band] *= inverse), ...);
  (ChangeRow<Rows + 1, Band>(column, diagonal), ...);
}

// The first `count` columns, whose rows are all there.
template <class Value>
WAFT_INLINE bool EliminateFirst(Value* values, std::size_t count)
{
  for (std::size_t j = 0; j < count; ++j)
  {
    Value* diagonal = values + j * (UsualBand + 1) + UsualBand;
    if (!IsPositive(*diagonal))
    {
      return false;
    }
    EliminateColumn<UsualBand>(diagonal, std::make_index_sequence<UsualBand>());
  }
  return true;
}

WAFT_SIMD_CLONES bool EliminateUsual(double* values, std::size_t count)
{
  return EliminateFirst(values, count);
}

WAFT_SIMD_CLONES bool EliminateUsual(Double4* values, std::size_t count)
{
  return EliminateFirst(values, count);
}

template <class Value>
WAFT_INLINE bool EliminateRest(Value* values, std::size_t band, std::size_t first, std::size_t size)
{
  for (std::size_t j = first; j < size; ++j)
  {
    Value* diagonal = values + j * (band + 1) + band;
    if (!IsPositive(*diagonal))
    {
      return false;
    }
    InvertRoot(*diagonal);
    const std::size_t rows = std::min(band, size - 1 - j);
    for (std::size_t d = 1; d <= rows; ++d)
    {
      const Value own = diagonal[d * band] *= *diagonal;
      for (std::size_t m = 1; m <= d; ++m)
      {
        diagonal[d * band + m] -= own * diagonal[m * band];
      }
    }
  }
  return true;
}

WAFT_SIMD_CLONES bool EliminateAny(double* values, std::size_t band, std::size_t first,
                                   std::size_t size)
{
  return EliminateRest(values, band, first, size);
}

WAFT_SIMD_CLONES bool EliminateAny(Double4* values, std::size_t band, std::size_t first,
                                   std::size_t size)
{
  return EliminateRest(values, band, first, size);
}

// What is known of the right hand side's next entries stays in registers.

template <class Value>
WAFT_INLINE void SolveFirst(const Value* values, std::size_t count, Value* b)
{
  std::array<Value, UsualBand> next;
  std::copy_n(b, UsualBand, next.begin());
  for (std::size_t j = 0; j < count; ++j)
  {
    const Value* diagonal = values + j * (UsualBand + 1) + UsualBand;
    const Value value = b[j] = next[0] * *diagonal;
    for (std::size_t d = 1; d < UsualBand; ++d)
    {
      next[d - 1] = next[d] - diagonal[d * UsualBand] * value;
    }
    next[UsualBand - 1] = b[j + UsualBand] - diagonal[UsualBand * UsualBand] * value;
  }
  std::copy(next.begin(), next.end(), b + count);
}

template <class Value>
WAFT_INLINE void SolveLast(const Value* values, std::size_t size, Value* b)
{
  std::array<Value, UsualBand> next; // [0] is the row's own
  std::reverse_copy(b + size - UsualBand, b + size, next.begin());
  for (std::size_t i = size; i-- > UsualBand;)
  {
    const Value* diagonal = values + i * (UsualBand + 1) + UsualBand;
    const Value value = b[i] = next[0] * *diagonal;
    for (std::size_t d = 1; d < UsualBand; ++d)
    {
      next[d - 1] = next[d] - *(diagonal - d) * value;
    }
    next[UsualBand - 1] = b[i - UsualBand] - *(diagonal - UsualBand) * value;
  }
  std::reverse_copy(next.begin(), next.end(), b);
}

/// L y = b for the first `count` columns, whose rows are all there.
WAFT_SIMD_CLONES void SolveDownUsual(const double* values, std::size_t count, double* b)
{
  SolveFirst(values, count, b);
}

WAFT_SIMD_CLONES void SolveDownUsual(const Double4* values, std::size_t count, Double4* b)
{
  SolveFirst(values, count, b);
}

/// L' x = y for the rows from the last to `UsualBand`.
WAFT_SIMD_CLONES void SolveUpUsual(const double* values, std::size_t size, double* b)
{
  SolveLast(values, size, b);
}

WAFT_SIMD_CLONES void SolveUpUsual(const Double4* values, std::size_t size, Double4* b)
{
  SolveLast(values, size, b);
}

} // namespace

template <class Value>
bool Banded<Value>::Factor()
{
  const std::size_t band = this->HalfBand();
  std::size_t done = 0;
  if (band == UsualBand && this->N > band)
  {
    done = this->N - band;
    if (!EliminateUsual(Lanes(this->Values.data()), done))
    {
      return false;
    }
  }
  return EliminateAny(Lanes(this->Values.data()), band, done, this->N);
}

template <class Value>
void Banded<Value>::Solve(std::vector<Value>& right) const
{
  auto* b = Lanes(right.data());
  const std::size_t band = this->HalfBand();
  const bool isUsual = band == UsualBand && this->N > band;
  std::size_t done = 0;
  if (isUsual)
  {
    done = this->N - band;
    SolveDownUsual(Lanes(this->Values.data()), done, b);
  }
  for (std::size_t j = done; j < this->N; ++j)
  {
    const auto* diagonal = Lanes(this->Values.data()) + j * this->Width + band;
    b[j] *= *diagonal;
    const std::size_t rows = std::min(band, this->N - 1 - j);
    for (std::size_t d = 1; d <= rows; ++d)
    {
      b[j + d] -= diagonal[d * band] * b[j];
    }
  }
  std::size_t left = this->N;
  if (isUsual)
  {
    SolveUpUsual(Lanes(this->Values.data()), this->N, b);
    left = band;
  }
  for (std::size_t i = left; i-- > 0;)
  {
    const auto* diagonal = Lanes(this->Values.data()) + i * this->Width + band;
    b[i] *= *diagonal;
    const std::size_t columns = std::min(band, i);
    for (std::size_t d = columns; d > 0; --d)
    {
      b[i - d] -= *(diagonal - d) * b[i];
    }
  }
}

template class Banded<double>;
template class Banded<FourDoubles>;

} // namespace waft
