// SPDX-License-Identifier: BSD-3-Clause
// Winds from files, whole series at once.
#pragma once

#include "Base/FieldSeries.h"
#include "Base/Types.h"
#include "Scene/Scene.h"

namespace waft
{

/// A wind from a .vti (one time, which then holds throughout), a .pvd (a series of .vti, in the
/// order of their times) or a .vdb, of the array that ChooseWind takes. A .vdb is the first of its
/// series (SeriesFiles): of those that have no lower number. What a .vdb has outside of its voxels
/// goes as far as the scene's volume.
Result ReadWindFile(const WindFile& file, const SceneInfo& scene, FieldSeries& wind);

} // namespace waft
