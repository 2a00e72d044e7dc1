// SPDX-License-Identifier: BSD-3-Clause
#include "Spacetime/Fields/WindEstimate.h"

#include "Spacetime/Model/SpacetimeOptions.h"

#include <cmath>

namespace waft
{

std::array<int, 3> LatticeDimensions(const Vec3& cells)
{
  std::array<int, 3> dimensions;
  for (int a = 0; a < 3; ++a)
  {
    dimensions[a] = std::max(2, static_cast<int>(std::round(cells[a]))) + 2;
  }
  return dimensions;
}

std::array<int, 3> WindLatticeOf(const Vec3& size, int cells)
{
  return LatticeDimensions(size * static_cast<double>(cells) / size.maxCoeff());
}

SplineWind MakeLattice(const Vec3& size, const std::array<int, 3>& dimensions, double framesPerKnot)
{
  SplineWind lattice;
  lattice.Dimensions = dimensions;
  for (int a = 0; a < 3; ++a)
  {
    lattice.Spacing[a] = size[a] / (dimensions[a] - 2);
    lattice.Origin[a] = -0.5 * lattice.Spacing[a];
  }
  lattice.FramesPerKnot = framesPerKnot;
  return lattice;
}

SplineWind MakeWindLattice(const SpacetimeModel& model, double framesPerKnot)
{
  return MakeLattice(model.Size,
                     model.WindNodes[0] > 0
                       ? model.WindNodes
                       : WindLatticeOf(model.Size, SpacetimeOptions().WindCells),
                     framesPerKnot);
}

int KnotsOf(const SpacetimeModel& model, double framesPerKnot)
{
  return static_cast<int>(std::ceil((model.NumberOfFrames - 1) / framesPerKnot)) + 1;
}

} // namespace waft
