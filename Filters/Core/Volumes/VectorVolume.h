// SPDX-License-Identifier: BSD-3-Clause
// A vector field from OpenVDB files: winds that other programs simulated.
#pragma once

#include "Base/FieldSeries.h"
#include "Base/Types.h"

#include <string>
#include <utility>
#include <vector>

namespace waft
{

/// Reads the wind of a series of .vdb files (SeriesFiles) with their frames, at the times of a time
/// line: the voxels' centres inside the box of the active voxels of all files, in metres as the
/// transform says. array: the grid's name, empty: as ChooseWind takes it of the first file that has
/// one; three grids of numbers do as well. The wind is zero in a file that has no wind, and outside
/// of its active voxels its background: where the volume goes on beyond the box, so does the
/// lattice, all over the volume where the background is not zero, else by a voxel. What is on other
/// voxels in later files is sampled. Transforms may scale and shift, not turn.
/// Fails, naming file and grid, on a file that cannot be read, on a file that has another wind than
/// the first, on a series without a wind or without active voxels, or with more than 256^3 voxels
/// in the box.
Result ReadVectorVolumes(const std::vector<std::pair<int, std::string>>& files,
                         const std::string& array, const Timeline& line, const Box& volume,
                         FieldSeries& wind);

} // namespace waft
