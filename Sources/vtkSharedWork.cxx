// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSharedWork.h"

#include "Base/SharedWork.h"
#include "Bridge/Pipeline/Ranks.h"
#include "Bridge/Pipeline/StageExecution.h"
#include "Bridge/Run/ServeRanks.h"

#include <vtkObjectFactory.h>

vtkStandardNewMacro(vtkSharedWork);

void vtkSharedWork::Serve(vtkMultiProcessController* controller)
{
  waft::ControllerCommunicator ranks(controller);
  waft::ServeRanks(ranks);
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
