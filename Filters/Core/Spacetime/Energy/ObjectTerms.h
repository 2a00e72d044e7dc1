// SPDX-License-Identifier: BSD-3-Clause
// Penalties of E on objects: clearance, approach and contact.
#pragma once

#include "Spacetime/Model/SpacetimeModel.h"

namespace waft
{

/// How far [dx] object o must keep from the floor and from obstacles at a frame: its clearance
/// radius and a hair's breadth, above a surface that it lands on its rest height alone.
double FloorClearance(const SpacetimeModel& model, int frame, std::size_t object);
double ObstacleClearance(const SpacetimeModel& model, int frame, std::size_t object);

/// How far apart [dx] two objects are to keep at a frame: the contact distance, but at marks that
/// both have to meet no more than those are apart, and little more just before and after. Leaves
/// that are to lie over each other have to come together.
double PairDistance(const SpacetimeModel& model, int frame, std::size_t a, std::size_t b);

struct ObjectTerms
{
  double Clearance = 0.0; // of depths below the required clearance (walls, floor, obstacles)
  double Approach = 0.0;  // of distances beyond the reach about the approach
  double Contact = 0.0;   // of depths below the distance of pairs of objects
};

/// Half the weighted sums of squares. Adds scale times their gradient to the six rows of `gradient`
/// where it is not null. Objects at fixed positions are left out.
ObjectTerms AddObjectTerms(const SpacetimeModel& model, int frame, double scale, const float* state,
                           float* gradient);

} // namespace waft
