// SPDX-License-Identifier: BSD-3-Clause
// The loops of the pressure solver over padded arrays, free of anything but floats, in a plain and
// an AVX2 version of equal results (no fused multiply-add in either).
#pragma once

#include <array>
#include <cstddef>

namespace waft
{

/// A lattice of cells with one ghost cell around it; rows are padded to whole vectors. Cell (i, j,
/// k) of [0, n) is at Index(i, j, k).
struct PaddedCells
{
  std::array<int, 3> N{ 0, 0, 0 };
  std::ptrdiff_t StrideY = 0;
  std::ptrdiff_t StrideZ = 0;

  PaddedCells() = default;
  explicit PaddedCells(const std::array<int, 3>& n) :
    N(n), StrideY((n[0] + 2 + 15) / 16 * 16), StrideZ(StrideY * (n[1] + 2))
  {
  }
  std::size_t Size() const { return static_cast<std::size_t>(this->StrideZ) * (this->N[2] + 2); }
  std::ptrdiff_t Index(int i, int j, int k) const
  {
    return (k + 1) * this->StrideZ + (j + 1) * this->StrideY + (i + 1);
  }
};

/// The operator (A x)_c = sum over the faces of c of weight (x_c - x_n). The weight of the face
/// between a cell and its neighbour towards -x is Wx at the cell, and so on.
struct CellOperator
{
  const float* Wx = nullptr;
  const float* Wy = nullptr;
  const float* Wz = nullptr;
  const float* InverseDiagonal = nullptr; // 0: not a cell of the air
};

/// to = from + omega (D^-1 (b + the neighbours' part of A) - from): damped Jacobi on plane k.
/// Mirror images of cells are treated alike to the last bit, so that a symmetric scene stays
/// symmetric.
void RelaxPlane(const PaddedCells& cells, const CellOperator& a, const float* b, float omega,
                const float* from, float* to, int k);
/// The same from zero.
void StartPlane(const PaddedCells& cells, const CellOperator& a, const float* b, float omega,
                float* to, int k);
/// The coarse right-hand sides of coarse plane k: sums of the residuals of their fine cells.
void RestrictResidualPlane(const PaddedCells& fine, const CellOperator& a, const float* b,
                           const float* x, const PaddedCells& coarse, const int* ratio,
                           float* coarseB, float* rowBuffer, int k);
/// Adds to each fine cell of plane k the value of its coarse cell.
void ProlongatePlane(const PaddedCells& fine, const PaddedCells& coarse, const int* ratio,
                     const float* coarseX, float* x, int k);

/// q = A s in plane k; returns the plane's part of s . q.
double ApplyPlane(const PaddedCells& cells, const CellOperator& a, const float* s, float* q, int k);
double DotPlane(const PaddedCells& cells, const float* a, const float* b, int k);
/// x += alpha s, r -= alpha q; returns the largest |r| of the plane.
float UpdatePlane(const PaddedCells& cells, float alpha, const float* s, const float* q, float* x,
                  float* r, int k);
/// s = z + beta s.
void DirectionPlane(const PaddedCells& cells, float beta, const float* z, float* s, int k);

} // namespace waft
