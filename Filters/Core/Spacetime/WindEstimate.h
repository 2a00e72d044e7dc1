// SPDX-License-Identifier: BSD-3-Clause
// The smooth wind that explains what vortices and gas dynamics leave of the accelerations.
#pragma once

#include "Spacetime/SpacetimeObjective.h"

#include <vector>

namespace waft
{

struct WindOptions
{
  double FramesPerKnot = 15.0;
  int GasStride = 8;          // every eighth gas particle witnesses, in turn
  double Ridge = 0.05;        // of the mean weight at a node
  double Curvature = 0.3;     // of the mean weight at a node, on second differences in space
  double TimeSmoothing = 0.3; // of the mean weight at a node, on first differences in time
  int Iterations = 30;        // of conjugate gradients
};

/// Nodes of the wind's lattice: five cells along the longest side, and half a cell beyond each
/// wall.
std::array<int, 3> WindLatticeOf(const Vec3& size);

/// A wind of this size [dx] without values.
SplineWind MakeWindLattice(const SpacetimeModel& model, double framesPerKnot);

/// Least squares over particles and frames: the wind's B-spline coefficients are the discrete curl
/// (central differences) of a vector potential on the nodes plus a mean flow at each knot in time,
/// so that its discrete divergence vanishes. The objective must just have been evaluated at
/// `state`; the new wind replaces the one in its model, which stays as it is.
SplineWind EstimateWind(const SpacetimeObjective& objective, const StateVector& state,
                        const WindOptions& options, const ParallelFor& parallel);

/// Value of a wind at a place and frame [dx / frame^2].
Vec3 SampleWind(const SplineWind& wind, const Vec3& x, double frame);

} // namespace waft
