// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Base/PointLattice.h"

#include <string>

class vtkImageData;

namespace waft
{

/// The points of an image. Fails on axes that are not those of the world and on what is no lattice
/// (CheckLattice); owner: for messages.
Result LatticeFromImage(vtkImageData* data, const std::string& owner, PointLattice& lattice);

/// Places the points of an image.
void LatticeToImage(const PointLattice& lattice, vtkImageData* data);

} // namespace waft
