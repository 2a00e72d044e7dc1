// SPDX-License-Identifier: BSD-3-Clause
// What a user sets of a whole run.
#pragma once

#include "Air/AirAssimilation.h"
#include "Chain/ChainTable.h"
#include "Planning/Takes.h"
#include "Rotation/RotationRefine.h"
#include "Spacetime/Model/SpacetimeOptions.h"

#include <cstdint>

namespace waft
{

/// Seeds of stages are not read: they are all Seed.
struct ChainOptions
{
  Quality Detail = Quality::Full;
  std::int64_t Seed = -1; // -1: the scene's own
  ChainStage StopAfter = ChainStage::Rotation;
  /// Seconds after which the best motion so far is turned and given; 0: no limit. With a limit two
  /// runs may differ.
  double TimeLimit = 0.0;
  PlanOptions Plan;
  TakeOptions Takes;
  AssimilationOptions Air;
  SpacetimeOptions Optimiser;
  RotationOptions Rotation;

  Result Validate() const;
  /// Those of a quality: the defaults, and of a preview a coarse air.
  static ChainOptions At(Quality quality);
};

} // namespace waft
