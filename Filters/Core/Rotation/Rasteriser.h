// SPDX-License-Identifier: BSD-3-Clause
// A mesh seen along a direction as a picture of triangle numbers: its foreshortened area, and the
// paper's drag torque summed over pixels.
#pragma once

#include "Base/Mesh.h"
#include "Base/Types.h"

#include <vector>

namespace waft
{

/// A picture of a mesh on the plane perpendicular to Direction. The plane's axes follow the
/// projected shape, and the window fits it, so that an edge-on sheet fills the picture too.
struct RasterView
{
  Vec3 Direction = Vec3::UnitZ(); // unit; the body moves along it through the air
  Vec3 AxisU = Vec3::UnitX();     // unit, with AxisV and Direction a right-handed frame
  Vec3 AxisV = Vec3::UnitY();
  double MinU = 0.0; // m, corner of the window, measured from the body's origin
  double MinV = 0.0;
  double StepU = 0.0; // m, size of a pixel
  double StepV = 0.0;
  int Resolution = 0;
  std::vector<int> TriangleIds; // per pixel, U fastest: the foremost triangle, or -1
  std::vector<double> Depths;   // m along Direction, of the foremost surface
  std::vector<int> Covered;     // per triangle: pixels that it covers
  std::vector<int> Visible;     // per triangle: pixels where it is foremost

  double PixelArea() const { return this->StepU * this->StepV; }
  int CoveredPixels() const;
  /// Foreshortened area [m^2].
  double Area() const { return this->CoveredPixels() * this->PixelArea(); }
};

/// resolution: pixels on each side, 1 or more. Both sides of a sheet count. An edge that two
/// triangles share gives each pixel to one of them only.
RasterView Rasterise(const TriangleMesh& mesh, const Vec3& direction, int resolution);

/// Force and torque about the body's origin.
struct Wrench
{
  Vec3 Force = Vec3::Zero();  // N
  Vec3 Torque = Vec3::Zero(); // N m
};

} // namespace waft
