// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Run/ServeRanks.h"

#include "Air/Run/AirCorrection.h"
#include "Air/Run/AirElsewhere.h"
#include "Air/Run/EachBody.h"
#include "Air/Run/TouchingBodies.h"
#include "Bridge/Pipeline/Ranks.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Database/DatabaseBuild.h"
#include "Planning/ScenePlans.h"
#include "Rotation/BodyTurner.h"

namespace waft
{

void ServeRanks(Communicator& ranks)
{
  const ParallelFor parallelFor = SmpFor();
  AirElsewhere elsewhere(ranks);
  const auto simulate = [&](ReadingStream& inputs, SharedItems& items)
  { return ServeSimulations(inputs, items, ItemsAtOnce(), parallelFor); };
  const auto plan = [&](ReadingStream& inputs, SharedItems& items)
  { return ServePlans(inputs, items, ItemsAtOnce(), parallelFor); };
  const auto drift = [&](ReadingStream& inputs, SharedItems& items)
  { return ServeBodies(inputs, items, ItemsAtOnce(), parallelFor, elsewhere); };
  const auto part = [&](ReadingStream& inputs, SharedItems&)
  { return ServeTouching(inputs, ranks, parallelFor, elsewhere); };
  const auto turn = [&](ReadingStream& inputs, SharedItems& items)
  { return ServeTurning(inputs, items, ItemsAtOnce(), parallelFor); };
  Serve(ranks, { { SimulationKind, simulate },
                 { PlanKind, plan },
                 { BodiesKind, drift },
                 { TouchingKind, part },
                 { TurningKind, turn } });
}

} // namespace waft
