// SPDX-License-Identifier: BSD-3-Clause
#pragma once

class vtkSMProxy;

namespace waft
{

/// Shows the marks of a flight as a table beside the active view, those first that are not met.
/// What is selected in it is selected in the view as well, since both show one port.
void TabulateMarks(vtkSMProxy* flight);

} // namespace waft
