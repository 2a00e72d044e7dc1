// SPDX-License-Identifier: BSD-3-Clause
// What lies on the ground and passes into what is around it.
#pragma once

#include <vtkSmartPointer.h>

class vtkActor;
class vtkPolyData;
class vtkTexture;

namespace waft
{

/// White, of an opacity that falls from `strength` in its middle to nothing at its rim.
vtkSmartPointer<vtkTexture> MakeSoftDisc(double strength);

constexpr double FloorColor[3] = { 0.86, 0.86, 0.84 };
constexpr double FloorStrength = 0.6; // of a floor in its middle

/// The upper side of a box (x, x, y, y, z, z), with places in a texture.
vtkSmartPointer<vtkPolyData> TopOf(const double box[6]);
/// What is not to be seen of a floor hides nothing.
void LeaveOutRim(vtkActor* floor);

} // namespace waft
