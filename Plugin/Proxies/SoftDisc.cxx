// SPDX-License-Identifier: BSD-3-Clause
#include "SoftDisc.h"

#include <vtkActor.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyData.h>
#include <vtkShaderProperty.h>
#include <vtkTexture.h>

#include <algorithm>
#include <cmath>

namespace waft
{

vtkSmartPointer<vtkTexture> MakeSoftDisc(double strength)
{
  constexpr int Texels = 128; // along a side
  vtkNew<vtkImageData> picture;
  picture->SetDimensions(Texels, Texels, 1);
  picture->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  for (int y = 0; y < Texels; ++y)
  {
    for (int x = 0; x < Texels; ++x)
    {
      const auto from = [](int texel) { return 2.0 * (texel + 0.5) / Texels - 1.0; };
      const double left = std::max(0.0, 1.0 - std::hypot(from(x), from(y)));
      const double share = left * left * (3.0 - 2.0 * left);
      auto* pixel = static_cast<unsigned char*>(picture->GetScalarPointer(x, y, 0));
      std::fill_n(pixel, 3, static_cast<unsigned char>(255));
      pixel[3] = static_cast<unsigned char>(std::lround(255.0 * strength * share));
    }
  }
  auto disc = vtkSmartPointer<vtkTexture>::New();
  disc->SetInputData(picture);
  disc->InterpolateOn();
  return disc;
}

vtkSmartPointer<vtkPolyData> TopOf(const double box[6])
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(box[0], box[2], box[5]);
  plane->SetPoint1(box[1], box[2], box[5]);
  plane->SetPoint2(box[0], box[3], box[5]);
  plane->Update();
  return plane->GetOutput();
}

void LeaveOutRim(vtkActor* floor)
{
  floor->GetShaderProperty()->AddFragmentShaderReplacement(
    "//VTK::TCoord::Impl", true, "//VTK::TCoord::Impl\n  if (gl_FragData[0].a < 0.002) discard;\n",
    false);
}

} // namespace waft
