// SPDX-License-Identifier: BSD-3-Clause
// What the fields cost for themselves, vortices and wind by one scale.
#pragma once

#include "Spacetime/Model/SpacetimeModel.h"
#include "Spacetime/Paper/NodeMatrix.h"

namespace waft
{

/// Fractions of the mean weight that the residuals of velocities have at a node of the wind's
/// lattice: with Ridge alone an acceleration of 1 m/s^2 everywhere costs that fraction of what
/// leaving it unexplained costs. A vortex is held by Ridge, as a wind of its values at the nodes
/// is.
struct FieldPenalty
{
  explicit FieldPenalty(const SpacetimeModel& model) : Ridge(model.FieldRidge) {}

  double Ridge;
  double Curvature = 0.3;     // on second differences in space
  double TimeSmoothing = 0.3; // on first differences in time
};

/// The mean weight at a node, of all particles over all frames.
double MeanNodeWeight(const SpacetimeModel& model, const SplineWind& lattice, int knots);

/// Of one component at one knot, without what binds it to other knots.
NodeMatrix PenaltyInSpace(const SplineWind& lattice, const FieldPenalty& penalty);

/// Sum of squares of a vortex of strength 1 at the nodes of all knots.
double VortexNorm(const SpacetimeModel& model, const SplineWind& lattice, const Vortex& vortex);

/// The part of E that is the fields' own.
double FieldCost(const SpacetimeModel& model, const AirFields& fields);

} // namespace waft
