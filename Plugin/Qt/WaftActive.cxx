// SPDX-License-Identifier: BSD-3-Clause
#include "WaftActive.h"

#include <pqPipelineSource.h>
#include <pqView.h>

#include <vtkCommand.h>
#include <vtkEventQtSlotConnect.h>
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

WaftActive::WaftActive(QObject* parent) : QObject(parent)
{
  auto* model = pqApplicationCore::instance()->getServerManagerModel();
  this->connect(model, &pqServerManagerModel::sourceAdded, this, &WaftActive::Listen);
  this->connect(model, &pqServerManagerModel::viewAdded, this, &WaftActive::Listen);
  this->Listen();
}

WaftActive::~WaftActive() = default;

void WaftActive::Listen()
{
  vtkSMProxySelectionModel* sources = waft::ChoiceOf("ActiveSources");
  vtkSMProxySelectionModel* views = waft::ChoiceOf("ActiveView");
  if (sources != nullptr && views != nullptr && sources != this->Chosen)
  {
    this->Choices->Disconnect();
    for (vtkSMProxySelectionModel* one : { sources, views })
    {
      this->Choices->Connect(one, vtkCommand::CurrentChangedEvent, this, SIGNAL(changed()), nullptr,
                             0.0, Qt::QueuedConnection);
    }
    this->Chosen = sources;
  }
}
