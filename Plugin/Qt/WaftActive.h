// SPDX-License-Identifier: BSD-3-Clause
// What is active in the window. ParaView's own list of it needs a header that Debian does not
// install.
#pragma once

#include <QObject>

#include <pqApplicationCore.h>
#include <pqServerManagerModel.h>

#include <vtkNew.h>
#include <vtkWeakPointer.h>

class pqPipelineSource;
class vtkEventQtSlotConnect;
class vtkObject;
class vtkSMProxy;
class vtkSMProxySelectionModel;

/// Says when another source or view is active.
class WaftActive : public QObject
{
  Q_OBJECT

public:
  explicit WaftActive(QObject* parent);
  ~WaftActive() override;

Q_SIGNALS:
  void changed();

private:
  /// A session has lists of its own, from its first source or view on.
  void Listen();

  vtkNew<vtkEventQtSlotConnect> Choices;
  vtkWeakPointer<vtkObject> Chosen; // that Choices hear of
};

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
