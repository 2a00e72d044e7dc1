// SPDX-License-Identifier: BSD-3-Clause
// The lattices of smooth winds.
#pragma once

#include "Spacetime/Energy/SpacetimeObjective.h"
#include "Spacetime/Fields/SplineFit.h"

#include <vector>

namespace waft
{

struct WindOptions
{
  double FramesPerKnot = 15.0;
  int GasStride = 8; // every eighth gas particle witnesses, in turn
  SplineFitOptions Fit;
};

/// Nodes of a lattice of about so many cells along each axis; two at least.
std::array<int, 3> LatticeDimensions(const Vec3& cells);

/// Nodes of the wind's lattice over a volume of that size: so many cells along the longest side,
/// and half a cell beyond each wall.
std::array<int, 3> WindLatticeOf(const Vec3& size, int cells);

/// A lattice of quadratic B-splines over a volume of that size [dx], without knots.
SplineWind MakeLattice(const Vec3& size, const std::array<int, 3>& dimensions,
                       double framesPerKnot);

/// The wind's lattice, without values.
SplineWind MakeWindLattice(const SpacetimeModel& model, double framesPerKnot);

/// Knots that span all frames.
int KnotsOf(const SpacetimeModel& model, double framesPerKnot);

} // namespace waft
