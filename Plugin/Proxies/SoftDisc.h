// SPDX-License-Identifier: BSD-3-Clause
// What lies on the ground and passes into what is around it.
#pragma once

#include <vtkSmartPointer.h>

class vtkTexture;

namespace waft
{

/// White, of an opacity that falls from `strength` in its middle to nothing at its rim.
vtkSmartPointer<vtkTexture> MakeSoftDisc(double strength);

} // namespace waft
