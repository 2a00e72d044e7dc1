// SPDX-License-Identifier: BSD-3-Clause
#include "WaftActive.h"

#include <pqPipelineSource.h>

#include <vtkSMOutputPort.h>
#include <vtkSMProxyManager.h>
#include <vtkSMProxySelectionModel.h>
#include <vtkSMSessionProxyManager.h>
#include <vtkSMSourceProxy.h>

namespace waft
{

vtkSMProxySelectionModel* ChoiceOf(const char* choice)
{
  vtkSMSessionProxyManager* session =
    vtkSMProxyManager::GetProxyManager()->GetActiveSessionProxyManager();
  return session != nullptr ? session->GetSelectionModel(choice) : nullptr;
}

vtkSMProxy* ChosenIn(const char* choice)
{
  vtkSMProxySelectionModel* model = ChoiceOf(choice);
  vtkSMProxy* proxy = model != nullptr ? model->GetCurrentProxy() : nullptr;
  if (auto* port = vtkSMOutputPort::SafeDownCast(proxy))
  {
    proxy = port->GetSourceProxy();
  }
  return proxy;
}

void Activate(pqPipelineSource* source)
{
  if (vtkSMProxySelectionModel* sources = ChoiceOf("ActiveSources"))
  {
    sources->SetCurrentProxy(source->getProxy(), vtkSMProxySelectionModel::CLEAR_AND_SELECT);
  }
}

} // namespace waft
