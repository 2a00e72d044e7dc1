// SPDX-License-Identifier: BSD-3-Clause
// What acts on the air from outside, and is found anew in the course of a run.
#pragma once

#include "Base/ForceFields.h"
#include "Spacetime/Model/SplineWind.h"

#include <vector>

namespace waft
{

struct AirFields
{
  std::vector<Vortex> Vortices; // in dx and frames
  SplineWind Wind;              // estimated
  double Cost = 0.0;            // their own part of E (Paper/FieldPenalty.h)
};

} // namespace waft
