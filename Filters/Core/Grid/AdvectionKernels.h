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

/// Where the air of a row of samples (0.., J, K) was one time step earlier: displacements in
/// voxels, within the reach of the arrays. Not places: their rounding would depend on the side of
/// the grid.
struct FootRow
{
  std::vector<float> X, Y, Z;
  int J = 0;
  int K = 0;
  void Resize(int n)
  {
    this->X.resize(n);
    this->Y.resize(n);
    this->Z.resize(n);
  }
};

/// Traces the samples (0.., j, k) of an array on the faces of faceAxis (-1: cell centres) back by a
/// Runge-Kutta step of second order (midpoint rule).
void TraceRow(const CarrierFlow& flow, int faceAxis, int j, int k, FootRow& feet);

/// Values at the feet: trilinear.
void SampleLinearRow(const StaggeredLayout& layout, const float* values, const FootRow& feet,
                     int count, float* out);
/// Cubic along each axis in turn, slopes limited so that no new extremum arises.
void SampleCubicRow(const StaggeredLayout& layout, const float* values, const FootRow& feet,
                    int count, float* out);
/// out = forward + (values - backward) / 2 held within the eight samples around the feet
/// (MacCormack, Selle et al. 2008). The three rows begin at sample (0, j, k).
void CorrectMacCormackRow(const StaggeredLayout& layout, const float* source, const FootRow& feet,
                          int count, const float* values, const float* forward,
                          const float* backward, float* out);

} // namespace waft
