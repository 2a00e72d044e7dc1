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
  for (std::size_t i = 0; i < this->N; ++i)
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
}

void BandedMatrix::Solve(std::vector<double>& b) const
{
  const std::size_t band = this->Width - 1;
  for (std::size_t j = 0; j < this->N; ++j)
  {
    const double* diagonal = this->Values.data() + j * this->Width + band;
    b[j] *= *diagonal;
    const std::size_t rows = std::min(band, this->N - 1 - j);
    for (std::size_t d = 1; d <= rows; ++d)
    {
      b[j + d] -= diagonal[d * band] * b[j];
    }
  }
  for (std::size_t i = this->N; i-- > 0;)
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
