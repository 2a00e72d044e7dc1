// SPDX-License-Identifier: BSD-3-Clause
#include "WaftBrowser.h"

#include "WaftActive.h"

#include <pqApplicationCore.h>
#include <pqOutputPort.h>
#include <pqPipelineBrowserWidget.h>
#include <pqPipelineSource.h>
#include <pqServerManagerModel.h>
#include <pqView.h>

#include <vtkAlgorithm.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataSet.h>
#include <vtkSMSourceProxy.h>
#include <vtkTable.h>

#include <QWidget>

namespace
{

const char* const Empty = "WaftIsEmpty"; // a property of the window's ports

bool IsEmpty(vtkDataObject* data)
{
  const bool isCounted = vtkDataSet::SafeDownCast(data) != nullptr ||
                         vtkCompositeDataSet::SafeDownCast(data) != nullptr ||
                         vtkTable::SafeDownCast(data) != nullptr;
  return isCounted && data->GetNumberOfElements(vtkDataObject::POINT) == 0 &&
         data->GetNumberOfElements(vtkDataObject::CELL) == 0 &&
         data->GetNumberOfElements(vtkDataObject::ROW) == 0;
}

} // namespace

WaftBrowser::WaftBrowser(QObject* parent) :
  pqPipelineModel(*pqApplicationCore::instance()->getServerManagerModel(), parent)
{
  this->connect(pqApplicationCore::instance()->getServerManagerModel(),
                &pqServerManagerModel::dataUpdated, this, &WaftBrowser::LookAt);
}

QVariant WaftBrowser::data(const QModelIndex& index, int role) const
{
  const QVariant shown = pqPipelineModel::data(index, role);
  const pqServerManagerModelItem* item = this->getItemFor(index);
  const bool isName = role == Qt::DisplayRole && index.column() == 0;
  return isName && item != nullptr && item->property(Empty).toBool() ? shown.toString() + " (empty)"
                                                                     : shown;
}

void WaftBrowser::LookAt(pqPipelineSource* source)
{
  auto* own = vtkAlgorithm::SafeDownCast(source->getProxy()->GetClientSideObject());
  for (pqOutputPort* port : source->getOutputPorts())
  {
    const bool isEmpty = own != nullptr && IsEmpty(own->GetOutputDataObject(port->getPortNumber()));
    if (isEmpty != port->property(Empty).toBool())
    {
      port->setProperty(Empty, isEmpty);
      const QModelIndex place = this->getIndexFor(port);
      Q_EMIT this->dataChanged(place, place);
    }
  }
}

void WaftBrowser::PutInto(QWidget* window)
{
  for (auto* browser : window->findChildren<pqPipelineBrowserWidget*>())
  {
    browser->setModel(new WaftBrowser(browser));
    browser->setActiveView(waft::ActiveOf<pqView*>("ActiveView"));
  }
}
