// SPDX-License-Identifier: BSD-3-Clause
// Semi-Lagrangian transport over the staggered layout, a plane at a time.
#pragma once

#include "Grid/StaggeredLayout.h"

#include <array>
#include <vector>

namespace waft
{

/// The air that carries: face velocities with ghosts filled, and the time step in voxels.
struct CarrierFlow
{
  const StaggeredLayout* Layout = nullptr;
  AxisEnds Ends{};
  std::array<const float*, 3> Velocity{ nullptr, nullptr, nullptr };
  std::array<float, 3> Scale{ 0.0f, 0.0f, 0.0f }; // dt / spacing; negative: backwards in time
};

/// Where the values of a row of samples are looked up: the sample at the lower corner of the voxel
/// around each foot, counted from the row's first sample, and the position within that voxel, 0..1.
struct FootRow
{
  std::vector<int> Corner;
  std::vector<float> Tx, Ty, Tz;
  void Resize(int n)
  {
    this->Corner.resize(n);
    this->Tx.resize(n);
    this->Ty.resize(n);
    this->Tz.resize(n);
  }
};

/// Displacements in voxels, one time step back, of the cell centres of plane k: a Runge-Kutta step
/// of second order (midpoint rule). Not positions: their rounding would depend on the side of the
/// grid.
void TracePlane(const CarrierFlow& flow, int k, const std::array<float*, 3>& displacement);

/// Feet of the samples (0.., j, k) on the faces of faceAxis (-1: cell centres): displacements of
/// the cells, their mean at a face; kept within the arrays.
void FindFeet(const StaggeredLayout& layout, const AxisEnds& ends,
              const std::array<const float*, 3>& displacement, int faceAxis, int j, int k,
              FootRow& feet);

/// Values at the feet of the row that begins at sample `row`: trilinear.
void SampleLinearRow(const StaggeredLayout& layout, const float* values, std::ptrdiff_t row,
                     const FootRow& feet, int count, float* out);
/// Cubic along each axis in turn, slopes limited so that no new extremum arises.
void SampleCubicRow(const StaggeredLayout& layout, const float* values, std::ptrdiff_t row,
                    const FootRow& feet, int count, float* out);
/// out = forward + (values - backward) / 2 held within the eight samples of `source` around the
/// feet (MacCormack, Selle et al. 2008). The other rows begin at sample `row`.
void CorrectMacCormackRow(const StaggeredLayout& layout, const float* source, std::ptrdiff_t row,
                          const FootRow& feet, int count, const float* forward,
                          const float* backward, float* out);

} // namespace waft
