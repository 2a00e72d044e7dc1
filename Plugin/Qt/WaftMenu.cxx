// SPDX-License-Identifier: BSD-3-Clause
#include "WaftMenu.h"

#include <pqApplicationCore.h>
#include <pqProxyGroupMenuManager.h>

#include <vtkPVXMLElement.h>
#include <vtkSMProxy.h>

#include <QAction>
#include <QWidget>

#include <string>

namespace waft
{

namespace
{

const char* const Name = "Waft";

bool IsOfWaft(vtkSMProxy* proxy)
{
  vtkPVXMLElement* hints = proxy != nullptr ? proxy->GetHints() : nullptr;
  vtkPVXMLElement* menu = hints != nullptr ? hints->FindNestedElementByName("ShowInMenu") : nullptr;
  return menu != nullptr &&
         std::string(menu->GetAttributeOrEmpty("category")).compare(0, 4, Name) == 0;
}

void NameActions(pqProxyGroupMenuManager* menu)
{
  for (QAction* action : menu->actions())
  {
    if (!action->text().contains(Name) && IsOfWaft(menu->getPrototype(action)))
    {
      action->setText(QString("%1 (%2)").arg(action->text(), Name));
    }
  }
}

} // namespace

void AddToSourcesMenu()
{
  pqApplicationCore::instance()->loadConfigurationXML(
    "<ParaViewSources><Category name=\"Waft\" menu_label=\"Waft\">"
    "<Proxy group=\"sources\" name=\"WaftAnimation\"/></Category></ParaViewSources>");
}

void NameInMenus(QWidget* window)
{
  for (auto* menu : window->findChildren<pqProxyGroupMenuManager*>())
  {
    const auto name = [menu] { NameActions(menu); };
    QObject::connect(menu, &pqProxyGroupMenuManager::menuPopulated, menu, name);
    name();
  }
}

} // namespace waft
