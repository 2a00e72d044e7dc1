// SPDX-License-Identifier: BSD-3-Clause
#include "WaftStages.h"

#include <pqApplicationCore.h>
#include <pqPipelineSource.h>
#include <pqServerManagerModel.h>

#include <vtkSMCompoundSourceProxy.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxy.h>

namespace waft
{

namespace
{

constexpr const char* Complete = "Complete";

bool IsComplete(vtkSMProxy* stage)
{
  vtkSMProperty* complete = stage->GetProperty(Complete);
  if (complete == nullptr)
  {
    return true;
  }
  stage->UpdatePropertyInformation(complete);
  return vtkSMPropertyHelper(complete).GetAsInt() != 0;
}

} // namespace

std::vector<HeldStage> HeldStages()
{
  std::vector<HeldStage> held;
  const auto model = pqApplicationCore::instance()->getServerManagerModel();
  for (pqPipelineSource* source : model->findItems<pqPipelineSource*>())
  {
    vtkSMProxy* proxy = source->getProxy();
    if (!IsComplete(proxy))
    {
      held.push_back({ source, proxy });
    }
    auto* bundle = vtkSMCompoundSourceProxy::SafeDownCast(proxy);
    for (unsigned int i = 0; bundle != nullptr && i < bundle->GetNumberOfProxies(); ++i)
    {
      if (!IsComplete(bundle->GetProxy(i)))
      {
        held.push_back({ source, bundle->GetProxy(i) });
      }
    }
  }
  return held;
}

void SetSlice(vtkSMProxy* source, double seconds)
{
  vtkSMPropertyHelper(source, "Slice", /*quiet=*/true).Set(seconds);
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
