// SPDX-License-Identifier: BSD-3-Clause
#include "WaftStages.h"

#include <pqApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqServerManagerModel.h>

#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>

namespace waft
{

namespace
{

bool WorksInSlices(vtkSMProxy* source)
{
  return source->GetProperty("WorkInSlices") != nullptr;
}

bool IsComplete(vtkSMProxy* stage)
{
  stage->UpdatePropertyInformation(stage->GetProperty("Complete"));
  return vtkSMPropertyHelper(stage, "Complete").GetAsInt() != 0;
}

} // namespace

std::vector<pqPipelineSource*> HeldStages()
{
  std::vector<pqPipelineSource*> held;
  const auto model = pqApplicationCore::instance()->getServerManagerModel();
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>())
  {
    if (WorksInSlices(source->getProxy()) && !IsComplete(source->getProxy()))
    {
      held.push_back(source);
    }
  }
  return held;
}

void WorkInSlices(vtkSMProxy* source)
{
  if (WorksInSlices(source))
  {
    source->InvokeCommand("WorkInSlices");
  }
}

WorkOfStage WorkOf(vtkSMProxy* stage)
{
  stage->UpdatePropertyInformation(stage->GetProperty("Message"));
  stage->UpdatePropertyInformation(stage->GetProperty("WorkDone"));
  const char* message = vtkSMPropertyHelper(stage, "Message").GetAsString();
  return { QString::fromUtf8(message != nullptr ? message : ""),
           vtkSMPropertyHelper(stage, "WorkDone").GetAsDouble() };
}

void GoOn(const std::vector<pqPipelineSource*>& held)
{
  for (pqPipelineSource* source : held)
  {
    source->getProxy()->InvokeCommand("GoOn");
    source->getProxy()->MarkModified(source->getProxy());
  }
}

} // namespace waft
