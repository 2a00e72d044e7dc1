// SPDX-License-Identifier: BSD-3-Clause
#include "Air/Drift/BandedMatrix.h"

#include "Base/Simd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace waft
{
namespace
{

constexpr std::size_t UsualBand = 8; // of drift

// The entry (i, j) is at [Band * i + Band + j]: those of a column are `Band` apart, those of a row
// side by side. Column by column, what follows it is changed at once: sums that do not wait for
// each other.

template <std::size_t Row, std::size_t Band>
WAFT_INLINE void ChangeRow(const std::array<double, Band + 1>& column, double* diagonal)
{
  for (std::size_t m = 1; m <= Row; ++m)
  {
    diagonal[Row * Band + m] -= column[Row] * column[m];
  }
}

template <std::size_t Band, std::size_t... Rows>
WAFT_INLINE void EliminateColumn(double* diagonal, std::index_sequence<Rows...>)
{
  const double inverse = *diagonal = 1.0 / std::sqrt(*diagonal); // kept as its inverse
  std::array<double, Band + 1> column;
  ((column[Rows + 1] = diagonal[(Rows + 1) * Band] *= inverse), ...);
  (ChangeRow<Rows + 1, Band>(column, diagonal), ...);
}

// The first `count` columns, whose rows are all there.
WAFT_SIMD_CLONES bool EliminateUsual(double* values, std::size_t count)
{
  for (std::size_t j = 0; j < count; ++j)
  {
    double* diagonal = values + j * (UsualBand + 1) + UsualBand;
    if (!(*diagonal > 0.0))
    {
      return false;
    }
    EliminateColumn<UsualBand>(diagonal, std::make_index_sequence<UsualBand>());
  }
  return true;
}

WAFT_SIMD_CLONES bool EliminateAny(double* values, std::size_t band, std::size_t first,
                                   std::size_t size)
{
  std::vector<double> column(band + 1);
  for (std::size_t j = first; j < size; ++j)
  {
    double* diagonal = values + j * (band + 1) + band;
    if (!(*diagonal > 0.0))
    {
      return false;
    }
    *diagonal = 1.0 / std::sqrt(*diagonal);
    const std::size_t rows = std::min(band, size - 1 - j);
    for (std::size_t d = 1; d <= rows; ++d)
    {
      column[d] = diagonal[d * band] *= *diagonal;
      for (std::size_t m = 1; m <= d; ++m)
      {
        diagonal[d * band + m] -= column[d] * column[m];
      }
    }
  }
  return true;
}

// What is known of the right hand side's next entries stays in registers.

/// L y = b for the first `count` columns, whose rows are all there.
WAFT_SIMD_CLONES void SolveDownUsual(const double* values, std::size_t count, double* b)
{
  std::array<double, UsualBand> next;
  std::copy_n(b, UsualBand, next.begin());
  for (std::size_t j = 0; j < count; ++j)
  {
    const double* diagonal = values + j * (UsualBand + 1) + UsualBand;
    const double value = b[j] = next[0] * *diagonal;
    for (std::size_t d = 1; d < UsualBand; ++d)
    {
      next[d - 1] = next[d] - diagonal[d * UsualBand] * value;
    }
    next[UsualBand - 1] = b[j + UsualBand] - diagonal[UsualBand * UsualBand] * value;
  }
  std::copy(next.begin(), next.end(), b + count);
}

/// L' x = y for the rows from the last to `UsualBand`.
WAFT_SIMD_CLONES void SolveUpUsual(const double* values, std::size_t size, double* b)
{
  std::array<double, UsualBand> next; // [0] is the row's own
  std::reverse_copy(b + size - UsualBand, b + size, next.begin());
  for (std::size_t i = size; i-- > UsualBand;)
  {
    const double* diagonal = values + i * (UsualBand + 1) + UsualBand;
    const double value = b[i] = next[0] * *diagonal;
    for (std::size_t d = 1; d < UsualBand; ++d)
    {
      next[d - 1] = next[d] - *(diagonal - d) * value;
    }
    next[UsualBand - 1] = b[i - UsualBand] - *(diagonal - UsualBand) * value;
  }
  std::reverse_copy(next.begin(), next.end(), b);
}

WAFT_SIMD_CLONES void MultiplyUsual(const double* values, std::size_t size, const double* x,
                                    double* y)
{
  for (std::size_t i = UsualBand; i < size; ++i)
  {
    const double* row = values + i * (UsualBand + 1);
    double sum = row[UsualBand] * x[i];
    for (std::size_t d = 0; d < UsualBand; ++d)
    {
      sum += row[d] * x[i - UsualBand + d];
      y[i - UsualBand + d] += row[d] * x[i];
    }
    y[i] += sum;
  }
}

} // namespace

bool BandedMatrix::Factor()
{
  const std::size_t band = this->Width - 1;
  std::size_t done = 0;
  if (band == UsualBand && this->N > band)
  {
    done = this->N - band;
    if (!EliminateUsual(this->Values.data(), done))
    {
      return false;
    }
  }
  return EliminateAny(this->Values.data(), band, done, this->N);
}

void BandedMatrix::Multiply(const std::vector<double>& x, std::vector<double>& y) const
{
  const std::size_t band = this->Width - 1;
  y.assign(this->N, 0.0);
  const bool isUsual = band == UsualBand && this->N > band;
  for (std::size_t i = 0; i < (isUsual ? band : this->N); ++i)
  {
    const double* diagonal = this->Values.data() + i * this->Width + band;
    double sum = *diagonal * x[i];
    for (std::size_t d = std::min(band, i); d > 0; --d)
    {
      const double entry = *(diagonal - d);
      sum += entry * x[i - d];
      y[i - d] += entry * x[i];
    }
    y[i] += sum;
  }
  if (isUsual)
  {
    MultiplyUsual(this->Values.data(), this->N, x.data(), y.data());
  }
}

void BandedMatrix::Solve(std::vector<double>& b) const
{
  const std::size_t band = this->Width - 1;
  const bool isUsual = band == UsualBand && this->N > band;
  std::size_t done = 0;
  if (isUsual)
  {
    done = this->N - band;
    SolveDownUsual(this->Values.data(), done, b.data());
  }
  for (std::size_t j = done; j < this->N; ++j)
  {
    const double* diagonal = this->Values.data() + j * this->Width + band;
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
    SolveUpUsual(this->Values.data(), this->N, b.data());
    left = band;
  }
  for (std::size_t i = left; i-- > 0;)
  {
    const double* diagonal = this->Values.data() + i * this->Width + band;
    b[i] *= *diagonal;
    const std::size_t columns = std::min(band, i);
    for (std::size_t d = columns; d > 0; --d)
    {
      b[i - d] -= *(diagonal - d) * b[i];
    }
  }
}

} // namespace waft
