// SPDX-License-Identifier: BSD-3-Clause
#include "Bridge/Data/ImageLattice.h"

#include <vtkImageData.h>
#include <vtkMatrix3x3.h>

namespace waft
{

Result LatticeFromImage(vtkImageData* data, const std::string& owner, PointLattice& lattice)
{
  if (data->GetNumberOfPoints() <= 0)
  {
    return Result::Error(owner + ": expected an image with points");
  }
  if (!data->GetDirectionMatrix()->IsIdentity())
  {
    return Result::Error(owner + ": expected an image whose axes are those of the world");
  }
  data->GetDimensions(lattice.Dimensions.data());
  data->GetSpacing(lattice.Spacing.data());
  data->GetPoint(0, lattice.Origin.data());
  return CheckLattice(owner, lattice);
}

void LatticeToImage(const PointLattice& lattice, vtkImageData* data)
{
  data->SetDimensions(lattice.Dimensions.data());
  data->SetOrigin(lattice.Origin.data());
  data->SetSpacing(lattice.Spacing.data());
}

} // namespace waft
