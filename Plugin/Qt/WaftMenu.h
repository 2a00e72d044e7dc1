// SPDX-License-Identifier: BSD-3-Clause
// What ParaView's menus lack of Waft.
#pragma once

namespace waft
{

/// ParaView leaves sources that open files out of the menu Sources; Waft Animation is there as
/// well, since a new one is chosen its file in the panel.
void AddToSourcesMenu();

} // namespace waft
