// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "Base/Result.h"
#include "Base/Types.h"

#include <array>
#include <string>

class vtkImageData;

namespace waft
{

/// The points of an image: origin of the first [m], spacing [m]. Fails on axes that are not those
/// of the world and on what is no lattice (CheckLattice); owner: for messages.
Result LatticeFromImage(vtkImageData* data, const std::string& owner,
                        std::array<int, 3>& dimensions, Vec3& origin, Vec3& spacing);

} // namespace waft
