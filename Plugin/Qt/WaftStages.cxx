// SPDX-License-Identifier: BSD-3-Clause
#include "WaftStages.h"

#include <pqApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqServerManagerModel.h>

#include <vtkSMCompoundSourceProxy.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>

#include <algorithm>

namespace waft
{

namespace
{

/// Itself or those that it bundles: all that can work in slices.
std::vector<vtkSMProxy*> StagesOf(vtkSMProxy* source)
{
  std::vector<vtkSMProxy*> stages{ source };
  auto* bundle = vtkSMCompoundSourceProxy::SafeDownCast(source);
  for (unsigned int i = 0; bundle != nullptr && i < bundle->GetNumberOfProxies(); ++i)
  {
    stages.push_back(bundle->GetProxy(i));
  }
  const auto last =
    std::remove_if(stages.begin(), stages.end(),
                   [](vtkSMProxy* stage) { return stage->GetProperty("WorkInSlices") == nullptr; });
  stages.erase(last, stages.end());
  return stages;
}

bool IsComplete(vtkSMProxy* stage)
{
  stage->UpdatePropertyInformation(stage->GetProperty("Complete"));
  return vtkSMPropertyHelper(stage, "Complete").GetAsInt() != 0;
}

} // namespace

std::vector<HeldStage> HeldStages()
{
  std::vector<HeldStage> held;
  const auto model = pqApplicationCore::instance()->getServerManagerModel();
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>())
  {
    for (vtkSMProxy* stage : StagesOf(source->getProxy()))
    {
      if (!IsComplete(stage))
      {
        held.push_back({ source, stage });
      }
    }
  }
  return held;
}

void WorkInSlices(vtkSMProxy* source)
{
  for (vtkSMProxy* stage : StagesOf(source))
  {
    stage->InvokeCommand("WorkInSlices");
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

void GoOn(const std::vector<HeldStage>& held)
{
  for (const HeldStage& one : held)
  {
    one.Stage->InvokeCommand("GoOn");
    one.Stage->MarkModified(one.Stage);
    one.Source->getProxy()->MarkModified(one.Source->getProxy());
  }
}

} // namespace waft
