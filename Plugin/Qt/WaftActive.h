// SPDX-License-Identifier: BSD-3-Clause
// What is active in the window. ParaView's own list of it needs a header that Debian does not
// install.
#pragma once

#include <pqApplicationCore.h>
#include <pqServerManagerModel.h>

class pqPipelineSource;
class vtkSMProxy;
class vtkSMProxySelectionModel;

namespace waft
{

/// A list of a session: ActiveSources or ActiveView.
vtkSMProxySelectionModel* ChoiceOf(const char* choice);
/// Its current proxy; of a port, the source.
vtkSMProxy* ChosenIn(const char* choice);

/// The item of the window for it, nullptr without one.
template <class Item>
Item ActiveOf(const char* choice)
{
  vtkSMProxy* proxy = ChosenIn(choice);
  return proxy != nullptr
           ? pqApplicationCore::instance()->getServerManagerModel()->findItem<Item>(proxy)
           : nullptr;
}

void Activate(pqPipelineSource* source);

} // namespace waft
