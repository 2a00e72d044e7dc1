// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSharedWork.h"

#include "Air/Run/AirCorrection.h"
#include "Air/Run/AirElsewhere.h"
#include "Air/Run/EachBody.h"
#include "Air/Run/TouchingBodies.h"
#include "Bridge/Pipeline/Ranks.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Database/DatabaseBuild.h"
#include "Planning/ScenePlans.h"
#include "Rotation/BodyTurner.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkSharedWork);

void vtkSharedWork::Serve(vtkMultiProcessController* controller)
{
  waft::ControllerCommunicator ranks(controller);
  const waft::ParallelFor parallelFor = waft::SmpFor();
  waft::AirElsewhere elsewhere(ranks);
  const auto simulate = [&](waft::ReadingStream& inputs, waft::SharedItems& items)
  { return waft::ServeSimulations(inputs, items, waft::ItemsAtOnce(), parallelFor); };
  const auto plan = [&](waft::ReadingStream& inputs, waft::SharedItems& items)
  { return waft::ServePlans(inputs, items, waft::ItemsAtOnce(), parallelFor); };
  const auto drift = [&](waft::ReadingStream& inputs, waft::SharedItems& items)
  { return waft::ServeBodies(inputs, items, waft::ItemsAtOnce(), parallelFor, elsewhere); };
  const auto part = [&](waft::ReadingStream& inputs, waft::SharedItems&)
  { return waft::ServeTouching(inputs, ranks, parallelFor, elsewhere); };
  const auto turn = [&](waft::ReadingStream& inputs, waft::SharedItems& items)
  { return waft::ServeTurning(inputs, items, waft::ItemsAtOnce(), parallelFor); };
  const auto fit = [&](waft::ReadingStream& inputs, waft::SharedItems&)
  { return waft::ServeWind(inputs, ranks, parallelFor); };
  waft::Serve(ranks, { { waft::SimulationKind, simulate },
                       { waft::PlanKind, plan },
                       { waft::BodiesKind, drift },
                       { waft::TouchingKind, part },
                       { waft::WindKind, fit },
                       { waft::TurningKind, turn } });
}

void vtkSharedWork::SetProcessesHere(int count)
{
  waft::SetProcessesHere(count);
}

void vtkSharedWork::Release(vtkMultiProcessController* controller)
{
  waft::SetProcessesHere(1);
  waft::ControllerCommunicator ranks(controller);
  waft::Release(ranks);
}
