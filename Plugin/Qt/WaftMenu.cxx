// SPDX-License-Identifier: BSD-3-Clause
#include "WaftMenu.h"

#include <pqApplicationCore.h>

namespace waft
{

void AddToSourcesMenu()
{
  pqApplicationCore::instance()->loadConfigurationXML(
    "<ParaViewSources><Category name=\"Waft\" menu_label=\"Waft\">"
    "<Proxy group=\"sources\" name=\"WaftAnimation\"/></Category></ParaViewSources>");
}

} // namespace waft
