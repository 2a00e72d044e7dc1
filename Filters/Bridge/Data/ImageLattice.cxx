// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/ImageLattice.h"

#include "Base/FieldSeries.h"

#include <vtkImageData.h>
#include <vtkMatrix3x3.h>

namespace waft
{

Result LatticeFromImage(vtkImageData* data, const std::string& owner,
                        std::array<int, 3>& dimensions, Vec3& origin, Vec3& spacing)
{
  if (data->GetNumberOfPoints() <= 0)
  {
    return Result::Error(owner + ": expected an image with points");
  }
  if (!data->GetDirectionMatrix()->IsIdentity())
  {
    return Result::Error(owner + ": expected an image whose axes are those of the world");
  }
  data->GetDimensions(dimensions.data());
  data->GetSpacing(spacing.data());
  data->GetPoint(0, origin.data());
  return CheckLattice(owner, dimensions, origin, spacing);
}

} // namespace waft
