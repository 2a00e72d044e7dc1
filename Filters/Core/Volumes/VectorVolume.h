// SPDX-License-Identifier: BSD-3-Clause
// A vector field from an OpenVDB file: winds that other programs simulated.
#pragma once

#include "Base/FieldSeries.h"

#include <string>

namespace waft
{

/// Reads the wind of a .vdb file as one step of a series at a time [s]: the voxels' centres inside
/// the box of active voxels, in metres as the transform says. array: the grid's name, empty: as
/// ChooseWind takes it; three grids of numbers do as well. The transform may scale and shift, not
/// turn. Fails on a file that cannot be read, without such a grid, without active voxels, or with
/// more than 256^3 voxels in the box.
Result ReadVectorVolume(const std::string& path, const std::string& array, double time,
                        FieldSeries& step);

} // namespace waft
