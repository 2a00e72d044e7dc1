// SPDX-License-Identifier: BSD-3-Clause
// The panel of properties in ParaView's window.
#pragma once

class QWidget;

namespace waft
{

/// Where the panel would scroll to the side, what is widest in it is narrower: of ParaView's own
/// rows for colours the button *Edit*, which keeps its icon and its tip, and the list of arrays.
void FitPanel(QWidget* window);

} // namespace waft
