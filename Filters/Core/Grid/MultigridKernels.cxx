// SPDX-License-Identifier: BSD-3-Clause
#include "Grid/MultigridKernels.h"

#include "Base/Simd.h"

#include <algorithm>

namespace waft
{
namespace
{

// Sums in lanes of their own, added in a fixed order: vectors without reassociation.
constexpr int Lanes = 16;

struct LaneSum
{
  float Lane[Lanes] = {};
  double Total() const
  {
    double sum = 0.0;
    for (const float lane : this->Lane)
    {
      sum += lane;
    }
    return sum;
  }
};

} // namespace

WAFT_SIMD_CLONES
void RelaxPlane(const PaddedCells& cells, const CellOperator& a, const float* b, float omega,
                const float* from, float* to, int k)
{
  const std::ptrdiff_t sy = cells.StrideY;
  const std::ptrdiff_t sz = cells.StrideZ;
  for (int j = 0; j < cells.N[1]; ++j)
  {
    const std::ptrdiff_t row = cells.Index(0, j, k);
    const float* wx = a.Wx + row;
    const float* wy = a.Wy + row;
    const float* wz = a.Wz + row;
    const float* d = a.InverseDiagonal + row;
    const float* rhs = b + row;
    const float* c = from + row;
    float* out = to + row;
#pragma GCC ivdep
    for (int i = 0; i < cells.N[0]; ++i)
    {
      const float sum = ((rhs[i] + (wx[i] * c[i - 1] + wx[i + 1] * c[i + 1])) +
                         (wy[i] * c[i - sy] + wy[i + sy] * c[i + sy])) +
                        (wz[i] * c[i - sz] + wz[i + sz] * c[i + sz]);
      out[i] = c[i] + omega * (sum * d[i] - c[i]);
    }
  }
}

WAFT_SIMD_CLONES
void StartPlane(const PaddedCells& cells, const CellOperator& a, const float* b, float omega,
                float* to, int k)
{
  for (int j = 0; j < cells.N[1]; ++j)
  {
    const std::ptrdiff_t row = cells.Index(0, j, k);
    const float* d = a.InverseDiagonal + row;
    const float* rhs = b + row;
    float* out = to + row;
#pragma GCC ivdep
    for (int i = 0; i < cells.N[0]; ++i)
    {
      out[i] = omega * (rhs[i] * d[i]);
    }
  }
}

WAFT_SIMD_CLONES
void RestrictResidualPlane(const PaddedCells& fine, const CellOperator& a, const float* b,
                           const float* x, const PaddedCells& coarse, const int* ratio,
                           float* coarseB, float* rowBuffer, int k)
{
  const std::ptrdiff_t sy = fine.StrideY;
  const std::ptrdiff_t sz = fine.StrideZ;
  const int n = fine.N[0];
  for (int j = 0; j < coarse.N[1]; ++j)
  {
    for (int i = 0; i < n + 1; ++i)
    {
      rowBuffer[i] = 0.0f;
    }
    for (int fk = k * ratio[2]; fk < std::min((k + 1) * ratio[2], fine.N[2]); ++fk)
    {
      for (int fj = j * ratio[1]; fj < std::min((j + 1) * ratio[1], fine.N[1]); ++fj)
      {
        const std::ptrdiff_t row = fine.Index(0, fj, fk);
        const float* wx = a.Wx + row;
        const float* wy = a.Wy + row;
        const float* wz = a.Wz + row;
        const float* c = x + row;
        const float* rhs = b + row;
#pragma GCC ivdep
        for (int i = 0; i < n; ++i)
        {
          const float flux = ((wx[i] * (c[i] - c[i - 1]) + wx[i + 1] * (c[i] - c[i + 1])) +
                              (wy[i] * (c[i] - c[i - sy]) + wy[i + sy] * (c[i] - c[i + sy]))) +
                             (wz[i] * (c[i] - c[i - sz]) + wz[i + sz] * (c[i] - c[i + sz]));
          rowBuffer[i] += rhs[i] - flux;
        }
      }
    }
    float* target = coarseB + coarse.Index(0, j, k);
    if (ratio[0] == 1)
    {
      std::copy(rowBuffer, rowBuffer + n, target);
      continue;
    }
    for (int i = 0; i < coarse.N[0]; ++i)
    {
      target[i] = rowBuffer[2 * i] + rowBuffer[2 * i + 1];
    }
  }
}

WAFT_SIMD_CLONES
void ProlongatePlane(const PaddedCells& fine, const PaddedCells& coarse, const int* ratio,
                     const float* coarseX, float* x, int k)
{
  const int n = fine.N[0];
  for (int j = 0; j < fine.N[1]; ++j)
  {
    const float* source = coarseX + coarse.Index(0, j / ratio[1], k / ratio[2]);
    float* target = x + fine.Index(0, j, k);
    if (ratio[0] == 1)
    {
      for (int i = 0; i < n; ++i)
      {
        target[i] += source[i];
      }
      continue;
    }
    for (int i = 0; i < n / 2; ++i)
    {
      target[2 * i] += source[i];
      target[2 * i + 1] += source[i];
    }
    if (n & 1)
    {
      target[n - 1] += source[n / 2];
    }
  }
}

WAFT_SIMD_CLONES
double ApplyPlane(const PaddedCells& cells, const CellOperator& a, const float* s, float* q, int k)
{
  const std::ptrdiff_t sy = cells.StrideY;
  const std::ptrdiff_t sz = cells.StrideZ;
  const int n = cells.N[0];
  double total = 0.0;
  for (int j = 0; j < cells.N[1]; ++j)
  {
    const std::ptrdiff_t row = cells.Index(0, j, k);
    const float* wx = a.Wx + row;
    const float* wy = a.Wy + row;
    const float* wz = a.Wz + row;
    const float* c = s + row;
    float* out = q + row;
#pragma GCC ivdep
    for (int i = 0; i < n; ++i)
    {
      out[i] = ((wx[i] * (c[i] - c[i - 1]) + wx[i + 1] * (c[i] - c[i + 1])) +
                (wy[i] * (c[i] - c[i - sy]) + wy[i + sy] * (c[i] - c[i + sy]))) +
               (wz[i] * (c[i] - c[i - sz]) + wz[i + sz] * (c[i] - c[i + sz]));
    }
  }
  total += DotPlane(cells, s, q, k);
  return total;
}

WAFT_SIMD_CLONES
double DotPlane(const PaddedCells& cells, const float* a, const float* b, int k)
{
  const int n = cells.N[0];
  const int whole = n / Lanes * Lanes;
  double total = 0.0;
  for (int j = 0; j < cells.N[1]; ++j)
  {
    const std::ptrdiff_t row = cells.Index(0, j, k);
    const float* p = a + row;
    const float* q = b + row;
    LaneSum sum;
    for (int i = 0; i < whole; i += Lanes)
    {
      for (int l = 0; l < Lanes; ++l)
      {
        sum.Lane[l] += p[i + l] * q[i + l];
      }
    }
    for (int i = whole; i < n; ++i)
    {
      sum.Lane[i - whole] += p[i] * q[i];
    }
    total += sum.Total();
  }
  return total;
}

WAFT_SIMD_CLONES
float UpdatePlane(const PaddedCells& cells, float alpha, const float* s, const float* q, float* x,
                  float* r, int k)
{
  const int n = cells.N[0];
  const int whole = n / Lanes * Lanes;
  float largest[Lanes] = {};
  for (int j = 0; j < cells.N[1]; ++j)
  {
    const std::ptrdiff_t row = cells.Index(0, j, k);
    const float* sRow = s + row;
    const float* qRow = q + row;
    float* xRow = x + row;
    float* rRow = r + row;
#pragma GCC ivdep
    for (int i = 0; i < n; ++i)
    {
      xRow[i] += alpha * sRow[i];
      rRow[i] -= alpha * qRow[i];
    }
    for (int i = 0; i < whole; i += Lanes)
    {
      for (int l = 0; l < Lanes; ++l)
      {
        const float size = rRow[i + l] < 0.0f ? -rRow[i + l] : rRow[i + l];
        largest[l] = size > largest[l] ? size : largest[l];
      }
    }
    for (int i = whole; i < n; ++i)
    {
      largest[0] = std::max(largest[0], rRow[i] < 0.0f ? -rRow[i] : rRow[i]);
    }
  }
  return *std::max_element(largest, largest + Lanes);
}

WAFT_SIMD_CLONES
void DirectionPlane(const PaddedCells& cells, float beta, const float* z, float* s, int k)
{
  for (int j = 0; j < cells.N[1]; ++j)
  {
    const std::ptrdiff_t row = cells.Index(0, j, k);
    const float* zRow = z + row;
    float* sRow = s + row;
#pragma GCC ivdep
    for (int i = 0; i < cells.N[0]; ++i)
    {
      sRow[i] = zRow[i] + beta * sRow[i];
    }
  }
}

} // namespace waft
