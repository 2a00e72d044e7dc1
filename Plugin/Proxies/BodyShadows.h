// SPDX-License-Identifier: BSD-3-Clause
// Shadows of bodies on the ground, cheap enough for each frame of thousands.
#pragma once

#include <vtkSmartPointer.h>

class vtkPolyData;

namespace waft
{

/// Under each body (`ObjectId` of points) a quadrangle on the ground, as long and wide as it is
/// seen from above, wider and paler the higher it flies: texture coordinates for a soft disc, and
/// as scalars the colour with its opacity. Null where the bodies' data have no ground (field data
/// `Ground`).
vtkSmartPointer<vtkPolyData> ShadowsOf(vtkPolyData* bodies);

} // namespace waft
