// SPDX-License-Identifier: BSD-3-Clause
#include "WaftMarks.h"

#include "WaftActive.h"
#include "WaftVerdict.h"

#include <pqApplicationCore.h>
#include <pqObjectBuilder.h>
#include <pqServerManagerModel.h>
#include <pqUndoStack.h>
#include <pqView.h>

#include <vtkNew.h>
#include <vtkPVArrayInformation.h>
#include <vtkPVDataInformation.h>
#include <vtkPVDataSetAttributesInformation.h>
#include <vtkSMParaViewPipelineControllerWithRendering.h>
#include <vtkSMPropertyHelper.h>
#include <vtkSMProxySelectionModel.h>
#include <vtkSMSourceProxy.h>
#include <vtkSMViewProxy.h>

#include <QAbstractItemModel>
#include <QTableView>

#include <algorithm>
#include <iterator>
#include <string>

namespace
{

constexpr const char* Told[] = { "Frame", "Kind", "ObjectId", "Radius", "Row", "Status", "Target" };

/// All others have what a stage wants to know.
void HideOthers(vtkSMViewProxy* view, vtkPVDataSetAttributesInformation* arrays)
{
  vtkSMPropertyHelper hidden(view, "HiddenColumnLabels");
  unsigned int count = 0;
  for (int i = 0; i < arrays->GetNumberOfArrays(); ++i)
  {
    const std::string name = arrays->GetArrayInformation(i)->GetName();
    if (std::find(std::begin(Told), std::end(Told), name) == std::end(Told))
    {
      hidden.Set(count++, name.c_str());
    }
  }
  view->UpdateVTKObjects();
}

} // namespace

namespace waft
{

void TabulateMarks(vtkSMProxy* flight)
{
  const auto [source, port] = MarksOf(flight);
  if (source == nullptr)
  {
    return;
  }
  SCOPED_UNDO_EXCLUDE();
  pqApplicationCore* core = pqApplicationCore::instance();
  pqServer* server = core->getServerManagerModel()->findServer(flight->GetSession());
  vtkSMProxy* before = ChosenIn("ActiveView");
  pqView* view = core->getObjectBuilder()->createView("SpreadSheetView", server);
  core->getObjectBuilder()->addToLayout(view);
  HideOthers(
    view->getViewProxy(),
    source->GetDataInformation(static_cast<unsigned int>(port))->GetPointDataInformation());
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  controller->Show(source, port, view->getViewProxy());
  view->forceRender();
  auto* table = view->widget()->findChild<QTableView*>();
  for (int column = 0; table != nullptr && column < table->model()->columnCount(); ++column)
  {
    if (table->model()->headerData(column, Qt::Horizontal).toString() == "Status")
    {
      table->sortByColumn(column, Qt::DescendingOrder); // 0: met
    }
  }
  ChoiceOf("ActiveView")->SetCurrentProxy(before, vtkSMProxySelectionModel::CLEAR_AND_SELECT);
}

} // namespace waft
