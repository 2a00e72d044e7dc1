// SPDX-License-Identifier: BSD-3-Clause
// The pair sums of smoothed particle hydrodynamics for one frame, fast: plain data in, plain data
// out, in single precision, with versions for AVX2 and AVX-512 chosen at run time. Lengths are in
// gas spacings dx, times in frames, rho0 = 1. Free of Eigen and of the standard library's
// templates, since it is compiled for several instruction sets.
#pragma once

#include <cstddef>
#include <cstdint>

namespace waft
{

/// State of one particle as the pair sums read it.
struct alignas(32) SphRecord
{
  float X, Y, Z, Mass;
  float U, V, W, Pressure; // velocity; P / rho^2
};

/// Adjoint state of one particle: of its acceleration, density and velocity average.
struct alignas(32) SphAdjointRecord
{
  float AX, AY, AZ, Density;
  float DX, DY, DZ, Unused;
};

/// What pair sums add up for one particle: two vectors, of accelerations and velocity averages or
/// of the adjoints of positions and velocities.
struct alignas(32) SphPairSum
{
  float First[3], Unused;
  float Second[3], AlsoUnused;
};

/// Wendland C2, support 2h: W = sigma s^4 (5 - 4 s), s = max(0, 1 - r / 2h), sigma = 21/(16 pi
/// h^3). grad_i W = F x_ij, F = -(5 sigma / h^2) s^3; F'/r = (7.5 sigma / h^3) s^2 / r.
struct SphConstants
{
  float SmoothingLength;
  float InverseSupport; // 1 / 2h
  float KernelScale;    // sigma
  float GradientScale;  // -5 sigma / h^2
  float SecondScale;    // 7.5 sigma / h^3
  float ViscousCore;    // 0.01 h^2
  float Kappa;          // alpha c0 h / rho0, between gas particles
  float ObjectKappa;    // the same between gas and object particles
  float GasMass;
  float ObjectMassThreshold; // lighter particles belong to objects
};

/// Far records without mass, that the caller appends after those of the particles: what fills a
/// group of pairs, one for each of its lanes, so that none waits for another. Adjoint records and
/// results have entries for them too; what sums leave there means nothing.
constexpr std::size_t SphFarRecords = 8;

/// Neighbours in groups of eight, each pair once: of a gas particle some of the gas about it, of an
/// object's all gas about it. The last group is filled with the index of the first far record.
struct SphNeighbours
{
  const std::uint32_t* Starts; // n + 1 entries, in groups of eight
  const std::uint16_t* Narrow; // either this list
  const std::uint32_t* Wide;   // or this one
};

/// Eight pairs of one i: x_i - x_j, s = 1 - r / 2h, and where j's record begins, in floats.
struct alignas(32) SphPairGroup
{
  float X[8], Y[8], Z[8], S[8];
  std::uint32_t Other[8];
};

/// The pairs of a frame within the support, as the density sum finds them and the other sums read
/// them. The caller gives room for as many groups as the neighbours have and one of far ones, which
/// ends them.
struct SphPairs
{
  std::uint32_t* Starts; // n + 1 entries, in groups
  SphPairGroup* Groups;
  float* Nearest; // n entries: the largest s of each i's pairs, or 0
};

/// A vortex at one instant: Strength already times its factor of time and 1 / 4 pi.
struct SphVortex
{
  float P1[3], P2[3];
  float Strength;
  float Core; // (CoreRadius |r0|)^2
};

/// A closed box and what its walls do: kernel mass beyond planes and a soft spring.
struct SphBox
{
  float Min[3], Max[3];
};

/// A field on the sites of a lattice whose first lies half a cell before the origin along each
/// axis, blended by quintics between them, constant beyond the outer ones.
struct SphRestField
{
  int Dimensions[3];
  float InverseCell[3];
  const float* Values; // a site, x fastest
};

/// A vector field of quadratic B-splines on a lattice of nodes: coefficients (x, y, z, 0) a node, x
/// fastest; node (i, j, k) stands at Origin + (i, j, k) / InverseSpacing.
struct SphSplineField
{
  int Dimensions[3];
  float Origin[3];
  float InverseSpacing[3];
  const float* Coefficients;
};

/// Structure-of-arrays views: three component rows of length Stride.
struct SphRows
{
  float* Data;
  std::size_t Stride;
  float* Row(int c) const { return this->Data + c * this->Stride; }
};

/// Arithmetic of long vectors of single precision with sums in double, in a fixed order.
struct VectorKernels
{
  double (*Dot)(std::size_t n, const float* a, const float* b);
  /// y += factor x; returns y . z.
  double (*AddDot)(std::size_t n, float factor, const float* x, float* y, const float* z);
};

/// One instruction set's versions. Sums run in the order of the lists: the result does not depend
/// on threads.
struct SphKernelTable
{
  const char* Name;

  /// density[i] = sum_j m_j W_ij, and the far ones' entries; fills `pairs`.
  void (*Density)(const SphConstants&, const SphRecord*, const SphNeighbours&, std::size_t n,
                  const SphPairs& pairs, float* density);
  /// Adds to First: -sum_j m_j (p_i + p_j + Pi_ij) F x_ij, to Second: sum_j m_j W_ij (v_j - v_i).
  /// n sums and the far ones', here and below.
  void (*Accelerate)(const SphConstants&, const SphRecord*, const SphPairs&, std::size_t n,
                     SphPairSum* sums);
  /// pressure[i] = -sum_j F (b_ij . x_ij), b_ij = m_j abar_i - m_i abar_j, and the far ones'.
  void (*AdjointPressure)(const SphConstants&, const SphRecord*, const SphAdjointRecord*,
                          const SphPairs&, std::size_t n, float* pressure);
  /// Adds the adjoint of positions to First, of velocities to Second.
  void (*AdjointState)(const SphConstants&, const SphRecord*, const SphAdjointRecord*,
                       const SphPairs&, std::size_t n, SphPairSum* sums);
  /// psi, its gradient (3 rows) and its Hessian (xx, xy, xz, yy, yz, zz): the kernel's mass beyond
  /// the planes of the box. n is padded to a multiple of eight.
  void (*Walls)(const SphConstants&, const SphBox&, std::size_t n, const float* x, const float* y,
                const float* z, float* psi, SphRows gradient, SphRows hessian);
  /// Adds the field to psi, gradient and Hessian as Walls gives them.
  void (*Rest)(const SphRestField&, std::size_t n, const float* x, const float* y, const float* z,
               float* psi, SphRows gradient, SphRows hessian);
  /// Adds force (3 rows) and Jacobian d f_i / d x_j (9 rows) of the vortices at n points, n padded.
  void (*Vortices)(const SphVortex*, std::size_t count, std::size_t n, const float* x,
                   const float* y, const float* z, SphRows force, SphRows jacobian);
  /// Adds value and Jacobian of a spline field at n points, times a factor.
  void (*Spline)(const SphSplineField&, float factor, std::size_t n, const float* x, const float* y,
                 const float* z, SphRows force, SphRows jacobian);
  /// Indices in [begin, end) whose points (x, y, z, sorted by cell) lie nearer to p than the square
  /// root of `radius2`, written to `found`; returns their number. Arrays have eight entries to
  /// spare.
  std::size_t (*Near)(const float* x, const float* y, const float* z, std::size_t begin,
                      std::size_t end, const float* p, float radius2, std::uint32_t* found);
  VectorKernels Vectors;
};

/// The fastest version that this machine runs.
const SphKernelTable& FastestSphKernels();
/// The version for any machine, for tests.
const SphKernelTable& PortableSphKernels();
/// Null where the machine does not have AVX2 and FMA.
const SphKernelTable* Avx2SphKernels();
/// Null where the machine does not have AVX-512 with its short vectors. Same bits as with AVX2.
const SphKernelTable* Avx512SphKernels();

} // namespace waft
