// SPDX-License-Identifier: BSD-3-Clause
// A whole scene as one data set.
#pragma once

#include "Base/FieldSeries.h"
#include "Base/Result.h"
#include "Scene/Scene.h"

class vtkMultiBlockDataSet;

namespace waft
{

/// What a scene file holds, over all its time.
struct SceneContents
{
  Scene Parts;      // its winds are those of Wind
  FieldSeries Wind; // empty: none
};

/// Blocks `Objects`, `Constraints`, `Obstacles` (where they stand at frame 0; of each that moves
/// the field data `Motion` and its id, a displacement a frame [m]), `Shapes`, `Vortices` and `Wind`
/// (one image a step, with the field data `Time` [s]); field data `Title`; of each block that has
/// one the field data `Authored`.
void SceneToBlocks(const SceneContents& scene, vtkMultiBlockDataSet* data);
/// The same back. Blocks that are missing are empty; only `Objects` has to be there.
Result SceneFromBlocks(vtkMultiBlockDataSet* data, SceneContents& scene);

} // namespace waft
