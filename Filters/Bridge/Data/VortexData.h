// SPDX-License-Identifier: BSD-3-Clause
// Vortices as lines from pole to pole.
#pragma once

#include "Base/ForceFields.h"
#include "Base/Result.h"
#include "Base/Types.h"
#include "Vortex/AirVortexFit.h"

#include <vector>

class vtkPolyData;

namespace waft
{

void VorticesToPolyData(const std::vector<Vortex>& vortices, const SceneInfo& info,
                        vtkPolyData* data);
/// With the field data `Explained` and, where some were left out, `ExplainedLeftOut`.
void AirVortexFitToPolyData(const AirVortexFit& fit, const SceneInfo& info, vtkPolyData* data);
/// Needs 2-point line cells with `Strength`, `CenterTime`, `Duration`, `CoreRadius`.
Result VorticesFromPolyData(vtkPolyData* data, std::vector<Vortex>& vortices);

} // namespace waft
