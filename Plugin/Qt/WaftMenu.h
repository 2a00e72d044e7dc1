// SPDX-License-Identifier: BSD-3-Clause
// What ParaView's menus lack of Waft.
#pragma once

class QWidget;

namespace waft
{

/// ParaView leaves sources that open files out of the menu Sources; Waft Animation is there as
/// well, since a new one is chosen its file in the panel.
void AddToSourcesMenu();

/// Sources and filters of Waft have its name in the window's menus: the quick search finds what is
/// in their texts.
void NameInMenus(QWidget* window);

} // namespace waft
